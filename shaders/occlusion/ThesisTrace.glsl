// Traces a ray through the thesis' layered fragment buffers (engine/occlusion/ThesisLayers.h). Returns the hit's distance and
// normal; a negative distance if there is none.
#include "occlusion/Bindings.glsl"
#include "occlusion/Octahedral.glsl"
#include "occlusion/Slab.glsl"

uniform int cells;
uniform int resolution;
uniform vec4 sphere; // centre, radius
uniform float pixelsPerMetre;

struct ThesisLayer {
    float depth;
    uint normal;
};
layout(std430, binding = OCCLUSION_STARTS) readonly buffer Starts { uint starts[]; };
layout(std430, binding = OCCLUSION_LAYERS) readonly buffer Layers { ThesisLayer layers[]; };

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

vec3 pixelFromBody(mat3 turn, vec3 position) {
    return turn * (position - sphere.xyz) * pixelsPerMetre + float(resolution) / 2.0;
}

vec4 traceLayers(vec3 origin, vec3 direction, float nearest) {
    const vec4 nothing = vec4(-1, 0, 0, 0);
    int view = nearestCubeDirection(direction);
    mat3 turn = transpose(frameAround(cubeDirection(view)));
    vec3 from = pixelFromBody(turn, origin), along = turn * direction;
    float size = float(resolution);
    float begin = nearest * pixelsPerMetre, end = 4.0 * size + distance(from, vec3(size / 2.0));
    for (int k = 0; k < 3; ++k)
        if (!clipSlab(from[k], along[k], 0.0, size, begin, end)) return nothing;
    ivec2 high = ivec2(resolution);
    CellWalk walk = walkStart(from.xy, along.xy, begin, end, ivec2(0), high);
    do {
        int pixel = (view * resolution + walk.cell.y) * resolution + walk.cell.x;
        float depthIn = from.z + walk.at * along.z, depthOut = from.z + walk.end * along.z;
        for (uint i = starts[pixel]; i < starts[pixel + 1]; ++i) {
            ThesisLayer layer = layers[i];
            if (layer.depth < depthIn || layer.depth >= depthOut) continue;
            vec3 normal = unpackDirection(layer.normal, 16);
            return vec4((layer.depth - from.z) / along.z / pixelsPerMetre,
                        dot(normal, direction) > 0.0 ? -normal : normal);
        }
    } while (walkStep(walk, ivec2(0), high));
    return nothing;
}
