// glTF 2.0 metallic-roughness, lit by the environment alone.
uniform mat3 envFromWorld;
#include "render/Attributes.glsl"
#include "light/LatLong.glsl"
#include "light/Environment.glsl"
#include "light/Surface.glsl"
#include "render/LightDifference.glsl"
#include "render/Clearcoat.glsl"
#ifdef PHONG_RINGS
#include "light/PhongRings.glsl"
#endif
#ifdef LAYERS
#include "occlusion/Layers.glsl"
#endif
#include "render/Output.glsl"
#include "render/Highlight.glsl"
#include "render/FilmDepth.glsl"

uniform vec3 eyeWorld;
uniform vec4 baseColourLin;
uniform vec3 emissiveLin;
uniform float metallic;
uniform float roughness;
uniform vec3 dielectricF0;
uniform float dielectricF90;
uniform sampler2D specularMap, specularColourMap, coatMap, coatRoughnessMap; // white if the material has none
uniform int specularUv, specularColourUv, coatUv, coatRoughnessUv;
uniform float normalScale;
uniform float occlusionStrength;
uniform float alphaCutoff;
uniform sampler2D baseColourMap, metallicRoughnessMap, normalMap, occlusionMap, emissiveMap;
uniform int baseColourUv, metallicRoughnessUv, normalUv, occlusionUv, emissiveUv;

// Object.vert writes those that the features need.
in vec4 perMapExposed;
in vec3 besidesExposed;
in vec3 worldPosition, worldNormal, fromEyeEnv, diffuseLin;
in vec4 worldTangent, envSelfOcclusion, vertexColourLin;
in vec3 waterLeft, waterVeiled; // render/Water.glsl
in float litUp;                 // from highlightOf()
#ifdef SECOND_UV
in vec4 vertexUv;
vec2 uvOf(int set) { return set == 0 ? vertexUv.xy : vertexUv.zw; }
#else
in vec2 vertexUv;
vec2 uvOf(int set) { return vertexUv; }
#endif
#ifdef VERTEX_DIFFUSE
in vec4 bodiesInLobe;
#elif defined(OCCLUDED) && !defined(VERTEX_LIT)
#include "occlusion/Bodies.glsl"
#endif
uniform float highlight; // 0 to 1
out vec4 colour;

// Returns the linear base colour and coverage; VERTEX_LIT: times light and exposure. Discards masked pixels.
vec4 baseColour() {
#ifdef VERTEX_LIT
    vec4 base = perMapExposed;
#else
    vec4 base = baseColourLin;
#ifdef VERTEX_COLOURS
    base *= vertexColourLin;
#endif
#endif
#ifdef BASE_COLOUR_MAP
    base *= texture(baseColourMap, uvOf(baseColourUv));
#endif
#ifdef ALPHA_MASK
    if (base.a < alphaCutoff) discard;
#endif
#ifndef ALPHA_BLEND
    base.a = 1.0;
#endif
    return base;
}

vec3 emitted() {
#ifdef EMISSIVE_MAP
    return emissiveLin * texture(emissiveMap, uvOf(emissiveUv)).rgb;
#else
    return emissiveLin;
#endif
}

vec3 throughWater(vec3 display) {
#ifdef WATER
    return sqrt(display * display * waterLeft + waterVeiled);
#else
    return display;
#endif
}

// Lightens an object that is marked for the player: display values get brighter, which every kind of colour
// vision sees, in a cave and before a white sky; at night less, so as not to dazzle. It lights nothing else.
vec3 lightened(vec3 display, float share) { return mix(display, min(1.9 * display + 0.12, vec3(1.0, 0.98, 0.90)), share); }

#ifndef VERTEX_LIT
// Returns the normal on the side that the eye sees, with the normal map. geometric: without the map.
vec3 shadingNormal(out vec3 geometric) {
    vec3 n = normalize(worldNormal);
    float facing = gl_FrontFacing ? 1.0 : -1.0;
    geometric = n * facing;
#ifdef NORMAL_MAP
    vec3 bump = texture(normalMap, uvOf(normalUv)).xyz * 2.0 - 1.0;
    bump.xy *= normalScale;
    vec3 t = worldTangent.xyz - n * dot(n, worldTangent.xyz);
    t *= inversesqrt(max(dot(t, t), 1e-12));
    n = normalize(bump.x * t + bump.y * (worldTangent.w * cross(n, t)) + bump.z * n);
#endif
    return n * facing;
}

// Filtered incoming radiance: around the normal for diffuse reflection (without and with bodies' occlusion),
// around the mirror direction for glossy reflection, and around the clearcoat's mirror direction.
struct Incoming {
    vec3 unoccluded, around, mirrored, coat;
};

Incoming incomingLight(vec3 n, vec3 geometric, vec3 v, float metal, float rough, float coatRough, Reflectance reflectance) {
    Incoming light;
    vec3 r = envFromWorld * reflect(-v, n);
#ifdef PHONG_RINGS
    light.mirrored = phongRings(r, rough);
#else
    light.mirrored = glossyRadiance(r, rough);
#endif
#ifdef VERTEX_DIFFUSE
    light.around = diffuseLin;
#else
    light.around = diffuseRadianceAtObject(envFromWorld * n);
#endif
    light.unoccluded = light.around;
#ifdef CLEARCOAT
    light.coat = glossyRadiance(envFromWorld * reflect(-v, geometric), coatRough);
#endif
#ifdef OCCLUDED
#ifndef VERTEX_DIFFUSE
    Shaded shaded = occludeByEllipsoids(envFromWorld * worldPosition, envFromWorld * n, r, rough, gl_FrontFacing ? envSelfOcclusion : vec4(0.0));
    light.around = max(light.around - shaded.taken, 0.0);
    vec4 bodiesInLobe = vec4(shaded.seenInLobe, shaded.lobeVisibility);
#endif
    light.mirrored = light.mirrored * bodiesInLobe.a + bodiesInLobe.rgb;
#ifdef CLEARCOAT
    light.coat = light.coat * bodiesInLobe.a + bodiesInLobe.rgb;
#endif
#endif
#ifdef LAYERS
    if (max(max(reflectance.around.r, reflectance.around.g), reflectance.around.b) > 0.02)
        light.around = diffuseWithLayers(worldPosition, n, geometric, light.around);
    light.mirrored = glossyWithLayers(worldPosition, reflect(-v, n), geometric, light.mirrored, metal, rough);
#endif
    return light;
}

// Returns the pixel's display values in the light of the environment.
vec3 litByPixel(vec3 base) {
    float metal = metallic, rough = roughness;
#ifdef METALLIC_ROUGHNESS_MAP
    vec4 mr = texture(metallicRoughnessMap, uvOf(metallicRoughnessUv));
    rough *= mr.g;
    metal *= mr.b;
#endif
    vec3 geometric;
    vec3 n = shadingNormal(geometric);
    vec3 toEye = eyeWorld - worldPosition;
    vec3 v = normalize(toEye);
    float nv = clamp(dot(n, v), 1e-3, 1.0);
#ifdef DIELECTRIC
    float specular = texture(specularMap, uvOf(specularUv)).a;
    vec3 f0 = dielectricF0 * specular * texture(specularColourMap, uvOf(specularColourUv)).rgb;
    Reflectance reflectance = reflectanceOf(base, metal, rough, nv, f0, dielectricF90 * specular);
#else
    Reflectance reflectance = reflectanceOf(base, metal, rough, nv);
#endif
    float coatRough = 0.0;
#ifdef CLEARCOAT
    coatRough = clearcoatRoughness * texture(coatRoughnessMap, uvOf(coatRoughnessUv)).g;
#endif
    Incoming light = incomingLight(n, geometric, v, metal, rough, coatRough, reflectance);
    float open = 1.0, openMirrored = 1.0;
#ifdef OCCLUSION_MAP
    open = mix(1.0, texture(occlusionMap, uvOf(occlusionUv)).r, occlusionStrength);
    // The share of a lobe around the mirror direction that a cavity leaves: Lagarde and de Rousiers 2014, "Moving Frostbite to
    // Physically Based Rendering", listing 26.
    openMirrored = clamp(pow(nv + open, exp2(-16.0 * rough - 1.0)) - 1.0 + open, 0.0, 1.0);
#endif
    // SHOW_...: returns one quantity instead of the light, see render::ShownQuantity.
#if defined(SHOW_NORMALS)
    return 0.5 + 0.5 * n;
#elif defined(SHOW_ROUGHNESS)
    return vec3(rough);
#elif defined(SHOW_OCCLUSION)
    return light.around * open / max(light.unoccluded, vec3(1e-4));
#elif defined(SHOW_DIFFUSE)
    return displayOfExposed(light.around * open * exposureScale);
#elif defined(SHOW_DEPTH)
    return vec3(1.0 / (1.0 + length(toEye)));
#endif
    vec3 radiance = reflectance.mirrored * light.mirrored * openMirrored + reflectance.around * light.around * open;
    radiance += emitted();
#ifdef CLEARCOAT
    float coat = clearcoat * texture(coatMap, uvOf(coatUv)).r * clearcoatReflectance(clamp(dot(geometric, v), 1e-3, 1.0), coatRough);
    radiance = mix(radiance, light.coat * openMirrored, coat);
#endif
    return lightened(throughWater(displayOfExposed(radiance * exposureScale)), highlightOf(highlight, dot(geometric, v)));
}
#elif defined(UNLIT)
// KHR_materials_unlit, always with VERTEX_LIT: shows the coded base colour unchanged, as the video's colours
// are at exposure 0. Exposure and tone curve, which convert light, do not apply, as in Khronos' sample
// renderer. Water between the object and the eye does apply.
vec3 litByVertex(vec3 baseLin) { return lightened(throughWater(srgbFromLinear(baseLin)), litUp); }
#else
vec3 litByVertex(vec3 baseExposed) {
    vec3 exposed = baseExposed + besidesExposed;
#ifdef EMISSIVE_MAP
    exposed += emitted() * exposureScale;
#endif
    return lightened(throughWater(displayOfExposed(exposed)), litUp);
}
#endif

// Returns 0 behind the film to 1 in front of it, over about a pixel, or 2 % of the distance where a body touches the film.
float filmVisibility(vec3 fromEyeEnv) {
    float before = inverseBeforeFilm(fromEyeEnv);
    return clamp(before / max(fwidth(before), 0.02 / length(fromEyeEnv)) + 0.5, 0.0, 1.0);
}

void main() {
    vec4 base = baseColour();
#ifdef VERTEX_LIT
    vec3 display = litByVertex(base.rgb);
#else
    vec3 display = litByPixel(base.rgb);
#endif
#ifdef ALPHA_BLEND
    colour = vec4(display * base.a, base.a);
#else
    colour = vec4(display, 1.0);
#endif
#ifdef FILM_DEPTH
    colour *= filmVisibility(fromEyeEnv);
#endif
}
