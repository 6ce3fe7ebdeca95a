// KHR_materials_clearcoat: a layer of varnish with an index of refraction of 1.5 over the whole surface, emitted light included.
// The varnish ignores the normal map. Needs dfgTable and light/Environment.glsl.
uniform float clearcoat, clearcoatRoughness;

// Returns the share of light that a full clearcoat reflects and withholds from the layers below. nv: n.v, above 0.
float clearcoatReflectance(float nv, float roughness) {
    vec2 dfg = textureLod(dfgTable, vec2(nv, roughness), 0.0).rg;
    return 0.04 * dfg.x + dfg.y;
}
