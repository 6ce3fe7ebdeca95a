// The share of the surrounding light that a surface reflects: glTF 2.0's metallic-roughness material by the split sum.
uniform sampler2D dfgTable; // x: n.v, y: roughness; scale and bias of F0 (engine/math/Brdf.h, Karis 2013)

struct Reflectance {
    vec3 mirrored; // factor for glossyRadiance(r, roughness), r the eye mirrored at the surface
    vec3 around;   // factor for diffuseRadiance(n)
};

// The shares of light reflected without entering the surface: at its first bounce, and at more between microfacets.
struct Bounced {
    vec3 single, multiple;
};

// f0, f90: Fresnel reflectance, head on and at grazing angles.
Bounced bouncedOf(vec3 f0, float f90, float roughness, float nv) {
    vec2 dfg = textureLod(dfgTable, vec2(nv, roughness), 0.0).rg;
    vec3 single = f0 * dfg.x + f90 * dfg.y;
    // Light that bounces between the microfacets more than once: Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for
    // Real-Time Image Based Lighting", eq. 20.
    float lost = 1.0 - (dfg.x + dfg.y);
    vec3 average = f0 + (f90 - f0) / 21.0;
    return Bounced(single, single * average / (1.0 - lost * average) * lost);
}

// baseLin: the base colour as a reflectance, 0 to 1. nv: n.v, above 0.
Reflectance reflectanceOf(vec3 baseLin, float metallic, float roughness, float nv) {
    Bounced bounced = bouncedOf(mix(vec3(0.04), baseLin, metallic), 1.0, roughness, nv);
    vec3 matte = baseLin * (1.0 - metallic) * (1.0 - bounced.single - bounced.multiple);
    return Reflectance(bounced.single, bounced.multiple + matte);
}

// Mixes a metal and a dielectric of its own Fresnel reflectance (KHR_materials_ior, KHR_materials_specular).
// The light that enters the dielectric is colourless, reduced by its reflection's strongest channel.
Reflectance reflectanceOf(vec3 baseLin, float metallic, float roughness, float nv, vec3 dielectricF0, float dielectricF90) {
    Bounced dielectric = bouncedOf(dielectricF0, dielectricF90, roughness, nv), metal = bouncedOf(baseLin, 1.0, roughness, nv);
    vec3 kept = dielectric.single + dielectric.multiple;
    vec3 matte = baseLin * (1.0 - max(max(kept.r, kept.g), kept.b));
    return Reflectance(mix(dielectric.single, metal.single, metallic), mix(dielectric.multiple + matte, metal.multiple, metallic));
}
