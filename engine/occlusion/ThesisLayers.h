// Orthographic linearised layered fragment buffers as Iorns 2016 (chapter 6) has them: a body seen from many
// directions, every layer's depth and normal kept, those of all pixels in one line with each pixel's first.
// shaders/occlusion/ThesisTrace.glsl traces rays through them.
#pragma once

#include "engine/core/Result.h"
#include "engine/occlusion/BodyMesh.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shoal::occlusion {

// One layer in one pixel: 64 bits.
struct ThesisLayer {
    float depth = 0;     // along the view's direction from the sphere's near side, in pixels
    uint32_t normal = 0; // body frame, octahedral, 2 x 16 bits (Directions.h)
};
static_assert(sizeof(ThesisLayer) == 8);

// How a body is seen: from the middle of each of cells x cells parts of equal angle of each face of a cube
// around it, in squares of resolution^2 pixels that just hold its sphere.
struct ThesisViews {
    int cells = 5; // views = 6 cells^2: 54 (3), 150 (5), 486 (9)
    int resolution = 64;
    Sphere sphere;

    // A pixel of margin, for what lies on the sphere itself.
    float pixelsPerMetre() const {
        return sphere.radius > 0 ? static_cast<float>(resolution - 1) / (2 * sphere.radius) : 1.0f;
    }
    // Body frame, metres, to pixels right, up and along the direction.
    glm::vec3 pixelFromBody(const glm::mat3& viewFromBody, const glm::vec3& position) const {
        return viewFromBody * (position - sphere.centre) * pixelsPerMetre() +
               static_cast<float>(resolution) / 2;
    }
};

// Unit vectors through the middles of all cells: face by face (+x, -x, +y ...), row by row.
std::vector<glm::vec3> cubeDirections(int cells);

struct ThesisLayers {
    struct Options {
        int cells = 5;       // 1 to 16: 6 to 1536 views
        int resolution = 64; // 1 to 1024
        size_t maxBytes = 256u << 20;
    };

    // Errors: a mesh that cannot be (BodyMesh.h), more than maxBytes.
    static Result<ThesisLayers> make(const BodyMesh& mesh, const Options& options);

    size_t bytes() const { return starts.size() * sizeof(uint32_t) + layers.size() * sizeof(ThesisLayer); }

    ThesisViews views;
    // First layer of each pixel (view by view, row by row), and the end of the last; then the layers, in each
    // pixel by growing depth.
    std::vector<uint32_t> starts;
    std::vector<ThesisLayer> layers;
};

} // namespace shoal::occlusion
