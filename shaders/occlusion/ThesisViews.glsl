// How a body is seen from the directions of a cube's faces: engine/occlusion/ThesisViews.h.
#include "occlusion/Bindings.glsl"

uniform int cells;
uniform int resolution;
uniform vec4 sphere; // centre, radius
uniform float pixelsPerMetre;

struct ThesisLayer {
    float depth;
    uint normal;
};
layout(std430, binding = OCCLUSION_STARTS) buffer Starts { uint starts[]; };
layout(std430, binding = OCCLUSION_LAYERS) buffer Layers { ThesisLayer layers[]; };

const float kQuarterTurn = 0.78539816339744831; // from the middle of a face to its edge

vec3 cubeDirection(int view) {
    int face = view / (cells * cells), y = view / cells % cells, x = view % cells;
    vec2 across = tan(kQuarterTurn * ((2.0 * vec2(x, y) + 1.0) / float(cells) - 1.0));
    vec3 v;
    v[face / 2] = face % 2 != 0 ? -1.0 : 1.0;
    v[(face / 2 + 1) % 3] = across.x;
    v[(face / 2 + 2) % 3] = across.y;
    return normalize(v);
}

int nearestCubeDirection(vec3 direction) {
    vec3 a = abs(direction);
    int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    vec2 across = vec2(direction[(axis + 1) % 3], direction[(axis + 2) % 3]) / a[axis];
    ivec2 cell = clamp(ivec2((atan(across) / kQuarterTurn + 1.0) / 2.0 * float(cells)), ivec2(0), ivec2(cells - 1));
    int face = 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
    return (face * cells + cell.y) * cells + cell.x;
}

// lookingAlong(axis, 0)
mat3 viewFromBody(vec3 axis) {
    float side = axis.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + axis.z), b = axis.x * axis.y * a;
    vec3 s = vec3(1.0 + side * axis.x * axis.x * a, side * b, -side * axis.x);
    vec3 t = vec3(b, side + axis.y * axis.y * a, -axis.y);
    return transpose(mat3(s, t, axis));
}

vec3 pixelFromBody(mat3 turn, vec3 position) {
    return turn * (position - sphere.xyz) * pixelsPerMetre + float(resolution) / 2.0;
}
