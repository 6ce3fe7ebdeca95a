// glTF 2.0 metallic-roughness, lit by the environment and by nothing else.
uniform mat3 envFromWorld;
#include "render/Attributes.glsl"
#include "light/LatLong.glsl"
#include "light/Environment.glsl"
#include "light/Surface.glsl"
#ifdef PHONG_RINGS
#include "light/PhongRings.glsl"
#endif
#ifdef LAYERS
#include "occlusion/Layers.glsl"
#endif
#include "render/Output.glsl"

uniform vec3 eyeWorld;
uniform vec4 baseColourLin;
uniform vec3 emissiveLin;
uniform float metallic;
uniform float roughness;
uniform float normalScale;
uniform float occlusionStrength;
uniform float alphaCutoff;
uniform sampler2D baseColourMap, metallicRoughnessMap, normalMap, occlusionMap, emissiveMap;
uniform int baseColourUv, metallicRoughnessUv, normalUv, occlusionUv, emissiveUv;

#ifdef VERTEX_LIT
in vec4 perMapExposed;
in vec3 besidesExposed;
#else
in vec3 worldPosition;
in vec3 worldNormal;
in vec4 worldTangent;
#ifdef OCCLUDED
in vec4 envSelfOcclusion;
#endif
#ifdef VERTEX_COLOURS
in vec4 vertexColourLin;
#endif
#endif
#ifdef SECOND_UV
in vec4 vertexUv;
vec2 uvOf(int set) { return set == 0 ? vertexUv.xy : vertexUv.zw; }
#else
in vec2 vertexUv;
vec2 uvOf(int set) { return vertexUv; }
#endif
#ifdef VERTEX_DIFFUSE
in vec3 diffuseLin;
#endif
#ifdef OCCLUDED
#ifdef VERTEX_DIFFUSE
in vec4 bodiesInLobe;
#elif !defined(VERTEX_LIT)
#include "occlusion/Bodies.glsl"
#endif
#endif
#ifdef WATER
in vec3 waterLeft, waterVeiled; // render/Water.glsl
#endif
out vec4 colour;

void main() {
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
#ifdef VERTEX_LIT
    vec3 exposed = base.rgb + besidesExposed;
#ifdef EMISSIVE_MAP
    exposed += emissiveLin * exposureScale * texture(emissiveMap, uvOf(emissiveUv)).rgb;
#endif
#else
    float metal = metallic, rough = roughness;
#ifdef METALLIC_ROUGHNESS_MAP
    vec4 mr = texture(metallicRoughnessMap, uvOf(metallicRoughnessUv));
    rough *= mr.g;
    metal *= mr.b;
#endif
    vec3 n = normalize(worldNormal);
    float facing = gl_FrontFacing ? 1.0 : -1.0;
#ifdef NORMAL_MAP
    vec3 bump = texture(normalMap, uvOf(normalUv)).xyz * 2.0 - 1.0;
    bump.xy *= normalScale;
    vec3 t = worldTangent.xyz - n * dot(n, worldTangent.xyz);
    t *= inversesqrt(max(dot(t, t), 1e-12));
    n = normalize(bump.x * t + bump.y * (worldTangent.w * cross(n, t)) + bump.z * n);
#endif
    n *= facing;

    vec3 toEye = eyeWorld - worldPosition;
    vec3 v = normalize(toEye);
    float nv = clamp(dot(n, v), 1e-3, 1.0);
    vec3 r = envFromWorld * reflect(-v, n);

    Reflectance reflectance = reflectanceOf(base.rgb, metal, rough, nv);
#ifdef PHONG_RINGS
    vec3 mirrored = phongRings(r, rough);
#else
    vec3 mirrored = glossyRadiance(r, rough);
#endif
#ifdef VERTEX_DIFFUSE
    vec3 around = diffuseLin;
#else
    vec3 around = diffuseRadiance(envFromWorld * n);
#endif
#ifdef SHOW_OCCLUSION
    vec3 unoccluded = around;
#endif
#ifdef OCCLUDED
#ifndef VERTEX_DIFFUSE
    Shaded shaded = occludeByEllipsoids(envFromWorld * worldPosition, envFromWorld * n, r, rough, gl_FrontFacing ? envSelfOcclusion : vec4(0.0));
    around = max(around - shaded.taken, 0.0);
    vec4 bodiesInLobe = vec4(shaded.seenInLobe, shaded.lobeVisibility);
#endif
    mirrored = mirrored * bodiesInLobe.a + bodiesInLobe.rgb;
#endif
#ifdef LAYERS
    vec3 geometric = normalize(worldNormal) * facing;
    if (max(max(reflectance.around.r, reflectance.around.g), reflectance.around.b) > 0.02)
        around = diffuseWithLayers(worldPosition, n, geometric, around);
    mirrored = glossyWithLayers(worldPosition, reflect(-v, n), geometric, mirrored, metal, rough);
#endif
    float open = 1.0, openMirrored = 1.0;
#ifdef OCCLUSION_MAP
    open = mix(1.0, texture(occlusionMap, uvOf(occlusionUv)).r, occlusionStrength);
    // What a cavity leaves of a lobe around the mirror direction: Lagarde and de Rousiers 2014, "Moving Frostbite to
    // Physically Based Rendering", listing 26.
    openMirrored = clamp(pow(nv + open, exp2(-16.0 * rough - 1.0)) - 1.0 + open, 0.0, 1.0);
#endif
    vec3 radiance = reflectance.mirrored * mirrored * openMirrored + reflectance.around * around * open;
    vec3 emitted = emissiveLin;
#ifdef EMISSIVE_MAP
    emitted *= texture(emissiveMap, uvOf(emissiveUv)).rgb;
#endif
    vec3 exposed = (radiance + emitted) * exposureScale;
#endif
    vec3 display = displayOfExposed(exposed);
#ifdef WATER
    display = sqrt(display * display * waterLeft + waterVeiled);
#endif
// SHOW_...: one quantity instead, see render::ShownQuantity.
#ifndef VERTEX_LIT
#if defined(SHOW_NORMALS)
    display = 0.5 + 0.5 * n;
#elif defined(SHOW_ROUGHNESS)
    display = vec3(rough);
#elif defined(SHOW_OCCLUSION)
    display = around * open / max(unoccluded, vec3(1e-4));
#elif defined(SHOW_DIFFUSE)
    display = displayOfExposed(around * open * exposureScale);
#elif defined(SHOW_DEPTH)
    display = vec3(1.0 / (1.0 + length(toEye)));
#endif
#endif
#ifdef ALPHA_BLEND
    colour = vec4(display * base.a, base.a);
#else
    colour = vec4(display, 1.0);
#endif
}
