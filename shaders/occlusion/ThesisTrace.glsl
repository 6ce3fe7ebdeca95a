// Traces a ray through the thesis' layered fragment buffers (engine/occlusion/ThesisViews.h). The hit's distance and normal; a negative distance where nothing is met.
#include "occlusion/ThesisViews.glsl"
#include "occlusion/Octahedral.glsl"
#include "occlusion/Slab.glsl"

vec4 traceLayers(vec3 origin, vec3 direction, float nearest) {
    const vec4 nothing = vec4(-1, 0, 0, 0);
    int view = nearestCubeDirection(direction);
    mat3 turn = viewFromBody(cubeDirection(view));
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
