#version 330 core
#include "light/LatLong.glsl"
#include "light/Environment.glsl"
#include "light/Surface.glsl"
#include "light/ToneCurve.glsl"
uniform vec3 eye;
uniform sampler2D baseColourMap, metallicRoughnessMap, normalMap;
in vec3 position, up;
in vec4 tangent;
in vec2 uv;
out vec4 colour;
void main() {
    vec3 bump = texture(normalMap, uv).xyz * 2.0 - 1.0, n = normalize(up);
    vec3 t = normalize(tangent.xyz - n * dot(n, tangent.xyz));
    n = normalize(bump.x * t + bump.y * tangent.w * cross(n, t) + bump.z * n);
    vec3 v = normalize(eye - position);
    float roughness = texture(metallicRoughnessMap, uv).g, metallic = texture(metallicRoughnessMap, uv).b;
    Reflectance surface = reflectanceOf(texture(baseColourMap, uv).rgb, metallic, roughness, max(dot(n, v), 1e-3));
    colour.rgb = displayFromRadiance(surface.mirrored * glossyRadiance(reflect(-v, n), roughness) +
                                     surface.around * diffuseRadiance(n));
}
