// Copies depth. FILM: takes the film's depth where that is nearer. Pairs with engine/render/HeadsetPasses.
uniform sampler2D depth;
uniform float part; // share of its width and height that is copied, about the middle
noperspective in vec2 uv;

#ifdef FILM
#include "light/LatLong.glsl"
#include "render/FilmDepth.glsl"
uniform mat3 envFromEye;
uniform vec2 rayScale, rayShift; // half extent and centre of the picture's plane, 1 m ahead
uniform vec2 planes;             // near, far, metres

float filmed() {
    vec3 ray = vec3((2.0 * uv - 1.0) * rayScale + rayShift, -1.0);
    float slant = length(ray);
    float inverseAhead = inverseAlong(envFromEye * (ray / slant)) * slant; // 1/m, along the view's axis
    return clamp(planes.y * (1.0 - planes.x * inverseAhead) / (planes.y - planes.x), 0.0, 1.0);
}
#endif

void main() {
    gl_FragDepth = textureLod(depth, (uv - 0.5) * part + 0.5, 0.0).r;
#ifdef FILM
    gl_FragDepth = min(gl_FragDepth, filmed());
#endif
}
