// The light that a vertex sends to the eye, for what does not fill the picture where the processor draws: the sums of
// Object.frag without relief, put so that they are linear in the base colour, which the pixel brings. For metals their further
// bounces are taken to have the base colour once. Needs light/Environment.glsl.
uniform sampler2D dfgTable;
uniform float metallic, roughness;

// p: world; self-occlusion: occlusion::traceSelfOcclusion(), light's frame; n, v: unit, world, to the surface's outside and to the eye.
void lightVertex(vec3 p, vec3 n, vec3 v, vec4 selfOcclusion, out vec3 perBaseLin, out vec3 besidesLin) {
    float nv = clamp(dot(n, v), 1e-3, 1.0);
    vec2 dfg = textureLod(dfgTable, vec2(nv, roughness), 0.0).rg;
    float lost = 1.0 - (dfg.x + dfg.y);
    const float f0 = 0.04, average = f0 + (1.0 - f0) / 21.0;
    float single = f0 * dfg.x + dfg.y, multiple = single * average / (1.0 - lost * average) * lost;
    vec3 around = diffuseRadiance(envFromWorld * n);
    vec3 mirrored = glossyRadiance(envFromWorld * reflect(-v, n), roughness);
#ifdef OCCLUDED
    Shaded shaded = occludeByEllipsoids(envFromWorld * p, envFromWorld * n, envFromWorld * reflect(-v, n), roughness, selfOcclusion);
    around = max(around - shaded.taken, 0.0);
    mirrored = mirrored * shaded.lobeVisibility + shaded.seenInLobe;
#endif
    perBaseLin = mix((1.0 - single - multiple) * around, dfg.x * mirrored + lost * around, metallic);
    besidesLin = mix(single * mirrored + multiple * around, dfg.y * mirrored, metallic);
}
