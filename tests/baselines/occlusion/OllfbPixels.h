// Reading the layers of one view; for Ollfb's own use.
#pragma once

#include "engine/occlusion/Directions.h"
#include "engine/occlusion/Ollfb.h"

#include <optional>

namespace shoal::occlusion {

struct OllfbPixels {
    const OllfbView& view;
    const OllfbRow* rows; // the view's first
    const uint16_t* starts;
    const OllfbLayer* layers;

    OllfbPixels(const Ollfb& all, const OllfbView& seen)
        : view(seen), rows(all.rows.data() + seen.firstRow), starts(all.starts.data()),
          layers(all.layers.data()) {}

    struct Layers {
        const OllfbLayer* begin;
        const OllfbLayer* end;
    };
    // Layers of a pixel within the view's size.
    Layers layersOf(const glm::ivec2& pixel) const {
        const OllfbRow& row = rows[pixel.y];
        if (pixel.x < row.begin || pixel.x >= row.end) return {nullptr, nullptr};
        const uint16_t* const start = starts + row.firstStart + (pixel.x - row.begin);
        const OllfbLayer* const first = layers + row.firstLayer;
        return {first + start[0], first + start[1]};
    }
    // At the pixel's middle, pixels.
    float depthOf(const OllfbLayer& layer) const {
        return static_cast<float>(layer.depth) * (view.depthRange_px / 65535);
    }
    // Outwards, view frame.
    static glm::vec3 normalOf(const OllfbLayer& layer) { return unpackDirection(layer.normal, 8); }
};

// The surface near a place: the layers of the four pixels around it, blended.
struct OllfbSurface {
    float depth = 0;     // under the place, pixels
    glm::vec2 slope{0};  // depth per pixel
    glm::vec3 normal{0}; // unit, outwards, view frame
};
// place: pixels; normal: what the surface's is about, view frame. None where no layer fits both.
std::optional<OllfbSurface> surfaceNear(const OllfbPixels& pixels, const glm::vec3& place,
                                        const glm::vec3& normal);

} // namespace shoal::occlusion
