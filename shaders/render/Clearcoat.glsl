// KHR_materials_clearcoat: a layer of varnish, of an index of refraction of 1.5, over all that the surface sends to the eye, what
// glows included. It lies smooth over the normal map. Needs dfgTable and light/Environment.glsl.
uniform float clearcoat, clearcoatRoughness;

// The share of light that a whole one reflects and keeps from what lies below. nv: n.v, above 0.
float clearcoatReflectance(float nv, float roughness) {
    vec2 dfg = textureLod(dfgTable, vec2(nv, roughness), 0.0).rg;
    return 0.04 * dfg.x + dfg.y;
}
