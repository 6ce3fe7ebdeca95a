// Orthographic linearised layered fragment buffers as in Iorns 2016 (chapter 6): views of a body from many
// directions, with the depth and normal of every layer. The layers of all pixels lie in one list, with an
// index of each pixel's first layer. shaders/occlusion/ThesisTrace.glsl traces rays through them.
#pragma once

#include "engine/core/Result.h"
#include "engine/occlusion/BodyMesh.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace shoal::occlusion {

// One layer in one pixel: 64 bits.
struct ThesisLayer {
    float depth = 0;     // along the view, in pixels, from half a pixel before the sphere's near side
    uint32_t normal = 0; // body frame, octahedral, 2 x 16 bits (Directions.h)
};
static_assert(sizeof(ThesisLayer) == 8);

// The views of a body: the faces of a cube around it are divided into cells x cells parts of equal angle;
// each part has a view along its middle, whose resolution^2 pixels just contain the body's sphere.
struct ThesisViews {
    int cells = 5; // number of views: 6 cells^2, so 54 for 3 cells, 150 for 5, 486 for 9
    int resolution = 64;
    Sphere sphere;

    // Returns the cells for a number of views; empty if no number of cells gives it.
    static std::optional<int> cellsFor(int views) {
        const auto cells = static_cast<int>(std::lround(std::sqrt(views / 6.0)));
        return 6 * cells * cells == views ? std::optional(cells) : std::nullopt;
    }

    // Half a pixel stays free on each side of the sphere, so that points on its edge are inside.
    float pixelsPerMetre() const {
        return sphere.radius > 0 ? static_cast<float>(resolution - 1) / (2 * sphere.radius) : 1.0f;
    }
    // Converts a position in the body frame, metres, to pixels right, up and along the direction.
    glm::vec3 pixelFromBody(const glm::mat3& viewFromBody, const glm::vec3& position) const {
        return viewFromBody * (position - sphere.centre) * pixelsPerMetre() +
               static_cast<float>(resolution) / 2;
    }
};

// Returns unit vectors through the middles of all cells: face by face (+x, -x, +y ...), row by row.
std::vector<glm::vec3> cubeDirections(int cells);

struct ThesisLayers {
    struct Options {
        int cells = 5;       // 1 to 16: 6 to 1536 views
        int resolution = 64; // 1 to 1024
        size_t maxBytes = 256u << 20;
    };

    // Fails for more than maxBytes.
    static Result<ThesisLayers> make(const BodyMesh& mesh, const Options& options);

    size_t bytes() const { return starts.size() * sizeof(uint32_t) + layers.size() * sizeof(ThesisLayer); }

    ThesisViews views;
    // starts holds the index of each pixel's first layer (view by view, row by row), then the number of all
    // layers. The layers of a pixel are sorted by ascending depth.
    std::vector<uint32_t> starts;
    std::vector<ThesisLayer> layers;
};

} // namespace shoal::occlusion
