// Light from an EnvironmentLight (engine/light/EnvironmentLight.h) as engine/light/PackedLight.h stores it:
// lightMap holds lat-long maps filtered by GGX lobes of roughness 10^(-k / 16), k = 0 .. smoothestMap, each with a border;
// map k's u, v times lightPlaces[k].xy plus .zw is its place. Map 0 is the radiance leaving a white matte surface.
// Needs light/LatLong.glsl.
uniform sampler2D lightMap;
uniform vec4 lightPlaces[17];
uniform float smoothestMap;

// SCALED_LIGHT: the maps hold radiance / lightScale, for a sun that exceeds the range of half floats.
#ifdef SCALED_LIGHT
uniform float lightScale;
#else
const float lightScale = 1.0;
#endif

vec3 filteredRadiance(vec2 uv, int map) {
    vec4 place = lightPlaces[map];
    return lightScale * textureLod(lightMap, uv * place.xy + place.zw, 0.0).rgb;
}

vec3 diffuseRadiance(vec3 normal) { return filteredRadiance(latLongFromDirection(normal), 0); }

#ifdef MIRRORS
// The radiance pyramid, for surfaces smoother than the smoothest map; the roughness of its levels and of that map.
uniform sampler2D radianceMap;
uniform float mirrorRoughness[6];
uniform int mirrorLevels;

// Returns the level, linear in 1 / alpha, alpha = roughness^2. Twin of lodFromRoughness() in engine/light/Lookup.h.
float mirrorLod(float roughness) {
    float alpha = max(roughness * roughness, 1e-6);
    float lod = 0.0;
    for (int k = 0; k < mirrorLevels; ++k) {
        float low = max(mirrorRoughness[k] * mirrorRoughness[k], 1e-6);
        float high = mirrorRoughness[k + 1] * mirrorRoughness[k + 1];
        lod += clamp((alpha - low) * high / (alpha * (high - low)), 0.0, 1.0);
    }
    return lod;
}
#endif

vec3 glossyRadiance(vec3 reflected, float roughness) {
    vec2 uv = latLongFromDirection(reflected);
#ifdef MIRRORS
    if (roughness < mirrorRoughness[mirrorLevels]) {
        float lod = mirrorLod(roughness), last = float(mirrorLevels - 1);
        vec3 mirrored = lightScale * textureLod(radianceMap, uv, min(lod, last)).rgb;
        return mix(mirrored, filteredRadiance(uv, int(smoothestMap)), clamp(lod - last, 0.0, 1.0));
    }
#endif
    // Between two maps the weight is linear in 1 / alpha too: (10^(f / 8) - 1) / (10^(1 / 8) - 1), approximated by a parabola
    // within 0.001.
    float at = clamp(-4.8165 * log2(max(roughness, 1e-3)), 0.0, smoothestMap);
#ifdef LEAN
    return filteredRadiance(uv, int(at + 0.5));
#endif
    float map = min(floor(at), max(smoothestMap - 1.0, 0.0));
    float f = at - map;
    f *= 0.8564 + 0.1436 * f;
    return mix(filteredRadiance(uv, int(map)), filteredRadiance(uv, int(min(map + 1.0, smoothestMap))), f);
}
