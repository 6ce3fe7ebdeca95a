// Marine snow: specks in a cube around the world's origin, where the viewer is. Each speck is a function of its index and of
// time, so nothing is simulated; specks that leave the cube enter on the other side.
#include "light/LatLong.glsl"
#include "light/Environment.glsl"
#include "render/Output.glsl"
#include "render/Water.glsl"
#include "render/FilmDepth.glsl"

uniform mat4 clipFromWorld;
uniform mat3 envFromWorld;
uniform vec3 drift_m;      // common drift of all specks, within the cube
uniform float swell;       // phase of a slow sway, radians
uniform float cube_m;      // side of the cube
uniform float pixelsPerSlope;
out vec3 speck; // display value
out float speckCover; // opacity in its middle

// Hashes an index to three numbers in 0 .. 1. Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg3d.
vec3 places(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    return vec3(v >> 8u) / 16777216.0;
}

void main() {
    uint n = uint(gl_VertexID);
    vec3 home = places(uvec3(n, 17u, 3u)), habit = places(uvec3(n, 5u, 29u));
    vec3 sway = 0.03 * sin(swell + 6.2831853 * habit) * vec3(1.0, 0.5, 1.0);
    vec3 world = (fract(home + (drift_m + sway) / cube_m) - 0.5) * cube_m;
    vec3 fromEye = world - eyeWorld;
    gl_Position = clipFromWorld * vec4(world, 1.0);
    float away = length(fromEye), ahead = max(gl_Position.w, 1e-3);

    float size_m = mix(0.003, 0.014, habit.x * habit.x * habit.x);
    float size_px = size_m * pixelsPerSlope / ahead;
    // At least two pixels wide, or it would flicker from pixel to pixel: a smaller speck covers less of them instead.
    const float kMin_px = 2.0;
    gl_PointSize = max(size_px, kMin_px);
    float cover = min(1.0, size_px / kMin_px);
    // Near specks are out of the eye's focus, and specks fade towards the cube's end.
    cover *= smoothstep(0.15, 0.45, away) * (1.0 - smoothstep(0.35, 0.5, away / cube_m));
    speckCover = 0.8 * cover;
#ifdef FILM_DEPTH
    // The film is compared at the speck's middle, over 2 % of the distance: no speck vanishes suddenly.
    if (cover > 0.0) speckCover *= clamp(inverseBeforeFilm(envFromWorld * fromEye) * away / 0.02 + 0.5, 0.0, 1.0);
#endif

    // Specks transmit as much light as they reflect: from all sides they are as bright as from above.
    vec3 lit = displayValue(diffuseRadiance(envFromWorld * vec3(0.0, 1.0, 0.0)));
    vec3 left, veil;
    throughWater(fromEye, envFromWorld, left, veil);
    speck = sqrt(lit * lit * left + veil);
}
