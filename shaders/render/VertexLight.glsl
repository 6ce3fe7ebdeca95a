// Computes the light that a vertex sends to the eye, for small objects on software renderers: the sums of Object.frag without
// the normal map, as a linear function of the base colour, which the pixel supplies. So a metal's multiple bounces contain the
// base colour only once, and a clearcoat does not dim emitted light. Needs render/LightDifference.glsl and roughness.
uniform sampler2D dfgTable;
uniform float metallic;
#ifdef DIELECTRIC
uniform vec3 dielectricF0;
uniform float dielectricF90;
#else
const vec3 dielectricF0 = vec3(0.04);
const float dielectricF90 = 1.0;
#endif
#ifdef CLEARCOAT
#include "render/Clearcoat.glsl"
#endif

// p: world; selfOcclusion: Primitive's (engine/scene/Model.h), light's frame; n, v: unit, world, outwards and to the eye.
void lightVertex(vec3 p, vec3 n, vec3 v, vec4 selfOcclusion, out vec3 perBaseLin, out vec3 besidesLin) {
    float nv = clamp(dot(n, v), 1e-3, 1.0);
    vec2 dfg = textureLod(dfgTable, vec2(nv, roughness), 0.0).rg;
    float lost = 1.0 - (dfg.x + dfg.y);
    vec3 average = dielectricF0 + (dielectricF90 - dielectricF0) / 21.0;
    vec3 single = dielectricF0 * dfg.x + dielectricF90 * dfg.y, multiple = single * average / (1.0 - lost * average) * lost;
    vec3 kept = single + multiple;
    vec3 around = diffuseRadianceAtObject(envFromWorld * n);
    vec3 mirrored = glossyRadiance(envFromWorld * reflect(-v, n), roughness);
#ifdef OCCLUDED
    Shaded shaded = occludeByEllipsoids(envFromWorld * p, envFromWorld * n, envFromWorld * reflect(-v, n), roughness, selfOcclusion);
    around = max(around - shaded.taken, 0.0);
    mirrored = mirrored * shaded.lobeVisibility + shaded.seenInLobe;
#endif
    perBaseLin = mix((1.0 - max(max(kept.r, kept.g), kept.b)) * around, dfg.x * mirrored + lost * around, metallic);
    besidesLin = mix(single * mirrored + multiple * around, dfg.y * mirrored, metallic);
#ifdef CLEARCOAT
    vec3 coat = glossyRadiance(envFromWorld * reflect(-v, n), clearcoatRoughness);
#ifdef OCCLUDED
    coat = coat * shaded.lobeVisibility + shaded.seenInLobe;
#endif
    float coatShare = clearcoat * clearcoatReflectance(nv, clearcoatRoughness);
    perBaseLin *= 1.0 - coatShare;
    besidesLin = mix(besidesLin, coat, coatShare);
#endif
}
