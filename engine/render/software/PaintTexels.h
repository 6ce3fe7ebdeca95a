// Paints objects into a frame's texels, on the processor. Twin of shaders/render/EquirectComposite.
#pragma once

#include "engine/core/Image.h"
#include "engine/render/EquirectComposite.h"
#include "engine/render/View.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace shoal::render {

// The layer that is painted, and the camera's response.
struct TexelPaint {
    // The layer: display values, premultiplied, blue first; rows from the bottom, without gaps.
    const uint32_t* layer = nullptr;
    glm::ivec2 layerSize{0}; // at least 2 x 2
    glm::mat3 eyeFromEnv{1};
    glm::vec2 rayScale{1}, rayShift{0}; // half the layer's image plane's extent at distance 1; its centre
    // Null: the layer is painted unchanged, and what follows is not used.
    const CameraUniforms* filmed = nullptr;
    const uint8_t* grain = nullptr;       // makeGrain()
    const ImageRgbF* scattered = nullptr; // squares of display values, lat-long
};

// Writes texels low to high - 1 of the frame, with the layer over them, into `out`, whose rows are outStride
// texels apart. They are so few that rays are nearly linear among them: a tile of FrameTiles. Needs
// canSampleFrames().
void paintTexels(const DisplayFrame& frame, const TexelPaint& paint, const glm::ivec2& low,
                 const glm::ivec2& high, uint32_t* out, ptrdiff_t outStride);

} // namespace shoal::render
