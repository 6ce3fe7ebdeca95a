// Light from an EnvironmentLight (engine/light/EnvironmentLight.h) stored in two textures:
//   diffuseMap  lat-long, radiance leaving a white matte surface by its normal
//   glossyMap   lat-long, level k holds radiance filtered by a GGX lobe of roughness glossyRoughness[k]; level 0 the mirror
// Both wrap in u and clamp in v. Needs light/LatLong.glsl.
uniform sampler2D diffuseMap;
uniform sampler2D glossyMap;
uniform float glossyRoughness[8];
uniform int glossyLevels;

vec3 diffuseRadiance(vec3 normal) { return textureLod(diffuseMap, latLongFromDirection(normal), 0.0).rgb; }

// Level whose roughness this is; between two levels linearly in 1 / alpha, alpha = roughness^2. Twin of lodFromRoughness() in
// engine/light/GlossyLevels.h, which says why.
float glossyLod(float roughness) {
    float alpha = max(roughness * roughness, 1e-6);
    float lod = 0.0;
    for (int k = 0; k + 1 < glossyLevels; ++k) {
        float low = max(glossyRoughness[k] * glossyRoughness[k], 1e-6);
        float high = glossyRoughness[k + 1] * glossyRoughness[k + 1];
        lod += clamp((alpha - low) * high / (alpha * (high - low)), 0.0, 1.0);
    }
    return lod;
}

vec3 glossyRadiance(vec3 reflected, float roughness) {
    return textureLod(glossyMap, latLongFromDirection(reflected), glossyLod(roughness)).rgb;
}
