#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_NORMAL) in vec3 normal;
layout(location = ATTRIBUTE_TANGENT) in vec4 tangent;
layout(location = ATTRIBUTE_UV0) in vec2 uv0;
layout(location = ATTRIBUTE_UV1) in vec2 uv1;
layout(location = ATTRIBUTE_COLOUR) in vec4 colourLin;
layout(location = ATTRIBUTE_JOINTS) in uvec4 joints;
layout(location = ATTRIBUTE_WEIGHTS) in vec4 weights;
layout(location = ATTRIBUTE_SELF_OCCLUSION) in vec4 selfOcclusion;
layout(location = ATTRIBUTE_SELF_OCCLUSION_BESIDE_OWN) in vec4 selfOcclusionBesideOwn;
uniform float ownStrength; // strength of the body's own occluders, 0 to 1

layout(std140) uniform JointBlock { mat4 worldFromJoint[MAX_JOINTS]; };
uniform mat4 clipFromWorld;
uniform mat3 envFromWorld;
#if defined(VERTEX_DIFFUSE) || defined(VERTEX_LIT)
#include "light/LatLong.glsl"
#include "light/Environment.glsl"
#include "render/LightDifference.glsl"
#endif
#if defined(OCCLUDED) && (defined(VERTEX_DIFFUSE) || defined(VERTEX_LIT))
#include "occlusion/Bodies.glsl"
#endif
uniform float roughness;
#ifdef VERTEX_LIT
#include "render/VertexLight.glsl"
#endif
#include "render/Output.glsl"
#ifdef WATER
#include "render/Water.glsl"
#else
uniform vec3 eyeWorld;
#endif
#include "render/Highlight.glsl"
uniform vec4 baseColourLin;
uniform vec3 emissiveLin;
uniform float twoSided;  // 1: the normal turns towards the eye
uniform float highlight; // 0 to 1

// Each output is written only if a feature needs it.
out vec3 worldPosition, worldNormal, waterLeft, waterVeiled, fromEyeEnv;
out vec4 worldTangent, envSelfOcclusion, vertexColourLin;
out vec3 diffuseLin;
out vec4 bodiesInLobe; // radiance that bodies send into the glossy lobe, and the free share of it
out float litUp;
// The exposed light sent to the eye is perMapExposed times the base colour's map plus besidesExposed. The
// alpha of perMapExposed is opacity. Vertices form these products, because software renderers fetch every
// uniform again for each pixel. UNLIT: perMapExposed is the map's linear factor.
out vec4 perMapExposed;
out vec3 besidesExposed;
#ifdef SECOND_UV
out vec4 vertexUv; // set 0 in xy, set 1 in zw
#else
out vec2 vertexUv;
#endif

mat4 worldFromVertex() {
#ifdef SKINNED
    return weights.x * worldFromJoint[joints.x] + weights.y * worldFromJoint[joints.y] +
           weights.z * worldFromJoint[joints.z] + weights.w * worldFromJoint[joints.w];
#else
    return worldFromJoint[0];
#endif
}

void main() {
    mat4 worldFromMesh = worldFromVertex();
    vec4 world = worldFromMesh * vec4(position, 1.0);
    mat3 m = mat3(worldFromMesh);
    // The cofactor matrix transforms normals correctly under any scale, without a division.
    mat3 cofactor = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    float handedness = dot(cross(m[0], m[1]), m[2]) < 0.0 ? -1.0 : 1.0;
    vec3 n = normalize(cofactor * normal) * handedness;
#ifdef SECOND_UV
    vertexUv = vec4(uv0, uv1);
#else
    vertexUv = uv0;
#endif
#ifdef OCCLUDED
    vec4 rest = mix(selfOcclusion, selfOcclusionBesideOwn, ownStrength);
    vec3 turned = m * rest.xyz;
    vec4 selfOcclusion = vec4(envFromWorld * turned * (length(rest.xyz) / max(length(turned), 1e-9)), rest.w);
#else
    const vec4 selfOcclusion = vec4(0.0);
#endif
#ifdef VERTEX_LIT
    vec3 v = normalize(eyeWorld - world.xyz);
    if (twoSided * dot(n, v) < 0.0) n = -n;
#ifdef UNLIT
    perMapExposed = baseColourLin;
#else
    vec3 perBase, besides;
    lightVertex(world.xyz, n, v, selfOcclusion, perBase, besides);
    perMapExposed = baseColourLin * vec4(perBase * exposureScale, 1.0);
#ifndef EMISSIVE_MAP
    besides += emissiveLin;
#endif
    besidesExposed = besides * exposureScale;
#endif
#ifdef VERTEX_COLOURS
    perMapExposed *= colourLin;
#endif
    litUp = highlightOf(highlight, dot(n, v));
#else
    worldPosition = world.xyz;
    worldNormal = n;
    worldTangent = vec4(m * tangent.xyz, tangent.w * handedness);
#ifdef OCCLUDED
    envSelfOcclusion = selfOcclusion;
#endif
#ifdef VERTEX_COLOURS
    vertexColourLin = colourLin;
#endif
#endif
#ifdef VERTEX_DIFFUSE
    diffuseLin = diffuseRadianceAtObject(envFromWorld * n);
#ifdef OCCLUDED
    Shaded shaded = occludeByEllipsoids(envFromWorld * world.xyz, envFromWorld * n,
                                  envFromWorld * reflect(normalize(world.xyz - eyeWorld), n), roughness, selfOcclusion);
    diffuseLin = max(diffuseLin - shaded.taken, 0.0);
    bodiesInLobe = vec4(shaded.seenInLobe, shaded.lobeVisibility);
#endif
#endif
#ifdef WATER
    throughWater(world.xyz - eyeWorld, envFromWorld, waterLeft, waterVeiled);
#endif
#ifdef FILM_DEPTH
    fromEyeEnv = envFromWorld * (world.xyz - eyeWorld);
#endif
    gl_Position = clipFromWorld * world;
}
