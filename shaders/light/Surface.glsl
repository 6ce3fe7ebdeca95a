// What a surface passes on of the light around it: glTF 2.0's metallic-roughness material by the split sum.
uniform sampler2D dfgTable; // x: n.v, y: roughness; scale and bias of F0 (engine/math/Brdf.h, Karis 2013)

struct Reflectance {
    vec3 mirrored; // of glossyRadiance(r, roughness), r the eye mirrored at the surface
    vec3 around;   // of diffuseRadiance(n)
};

// baseLin: the base colour as a reflectance, 0 to 1. nv: n.v, above 0.
Reflectance reflectanceOf(vec3 baseLin, float metallic, float roughness, float nv) {
    vec3 f0 = mix(vec3(0.04), baseLin, metallic);
    vec2 dfg = textureLod(dfgTable, vec2(nv, roughness), 0.0).rg;
    vec3 single = f0 * dfg.x + dfg.y;
    // Light that bounces between the microfacets more than once: Fdez-Aguera 2019, "A Multiple-Scattering Microfacet
    // Model for Real-Time Image Based Lighting", eq. 20.
    float lost = 1.0 - (dfg.x + dfg.y);
    vec3 average = f0 + (1.0 - f0) / 21.0;
    vec3 multiple = single * average / (1.0 - lost * average) * lost;
    vec3 matte = baseLin * (1.0 - metallic) * (1.0 - single - multiple);
    return Reflectance(single, multiple + matte);
}
