// Orthographic linearised layered fragment buffers: views of a body from many directions, with all layers of
// its surface at each pixel, so that shaders can trace rays through it (shaders/occlusion/Ollfb.glsl). After
// Iorns 2016, chapter 6, with additions:
// - A layer is a plane with the slope of its normal, and stores which sixteenths of its pixel it covers. So
//   steep surfaces have no gaps, and silhouettes are four times as fine as pixels.
// - The space between two layers is inside the body. A ray that is outside in one cell and inside in the next
//   has crossed the wall between them, however steep.
// - A hit's exact position and normal are read in the view that looks straight at the surface, interpolated
//   between four pixels.
// - A view serves both directions of its axis, and is cropped and rotated to the body.
// - 48 bits a layer, 16 a pixel.
#pragma once

#include "engine/core/Result.h"
#include "engine/occlusion/BodyMesh.h"
#include "engine/occlusion/Directions.h"

#include <cstdint>
#include <vector>

namespace shoal::occlusion {

// One layer of the surface in one pixel.
struct OllfbLayer {
    uint16_t depth = 0;  // depth of its plane at the pixel's middle, 0 .. 65535 over the view's range
    uint16_t normal = 0; // outwards, view frame, octahedral, 2 x 8 bits (Directions.h)
    uint16_t coverage =
        0; // bit 4 y + x: the sample at ((x + 1/2) / 4, (y + 1/2) / 4) of the pixel is covered
};
static_assert(sizeof(OllfbLayer) == 6, "48 bits a layer");

// Greatest slope of a plane, pixels of depth per pixel; steeper planes are tilted to it.
inline constexpr float kSteepest = 12;
// Margin of a view's depth range on either side of the body: a plane may lie there at its pixel's middle.
inline constexpr float kDepthMargin_px = kSteepest * 0.75f;

struct OllfbView {
    glm::mat3 viewFromBody{1};
    glm::vec3 low{0};         // view frame, pixels: position of the pixels' origin
    float pixelsPerMetre = 1; // along all three axes
    float depthRange_px = 1;  // of OllfbLayer::depth, margins included
    glm::ivec2 size{0};       // pixels
    uint32_t firstRow = 0;    // index into Ollfb::rows

    glm::vec3 pixelFromBody(const glm::vec3& position) const {
        return viewFromBody * position * pixelsPerMetre - low;
    }
};

// A row of pixels of a view.
struct OllfbRow {
    uint32_t firstLayer = 0;     // index into Ollfb::layers
    uint32_t firstStart = 0;     // index into Ollfb::starts, of pixel `begin`
    uint16_t begin = 0, end = 0; // range of pixels that have layers
};
static_assert(sizeof(OllfbRow) == 12);

struct Ollfb {
    struct Options {
        int views = 150;     // axes over half the sphere; 1 to 4096
        int resolution = 64; // pixels along the longer side of a view; 1 to 256
        size_t maxBytes = 64u << 20;
    };

    // Fails for more than maxBytes or 65535 layers in a row of pixels. A body without triangles or extent is
    // hit by no ray.
    static Result<Ollfb> make(const BodyMesh& mesh, const Options& options);

    size_t bytes() const {
        return axes.table.size() * sizeof(uint16_t) + views.size() * sizeof(OllfbView) +
               rows.size() * sizeof(OllfbRow) + starts.size() * sizeof(uint16_t) +
               layers.size() * sizeof(OllfbLayer);
    }

    Sphere sphere;
    // Result of isClosed(). If true, the space between two layers is inside, and rays hit surfaces only where
    // they enter, as with back-face culling; otherwise rays hit surfaces from both sides.
    bool closed = false;

    // Pixel x of a row has the layers from firstLayer + starts[firstStart + x - begin] up to the first of the
    // next pixel, by ascending depth.
    Axes axes;
    std::vector<OllfbView> views;
    std::vector<OllfbRow> rows;
    std::vector<uint16_t> starts;
    std::vector<OllfbLayer> layers;
};

// Returns the depth per pixel of the plane with this normal, whose z is not zero.
inline glm::vec2 slopeOf(const glm::vec3& normal) { return -glm::vec2(normal) / normal.z; }

} // namespace shoal::occlusion
