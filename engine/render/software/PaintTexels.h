// Paints objects into a frame's texels, on the processor. Twin of shaders/render/EquirectComposite.
#pragma once

#include "engine/core/Image.h"
#include "engine/render/EquirectComposite.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace shoal::render {

// The layer that is painted, and the camera's response.
struct TexelPaint {
    // The layer: display values, premultiplied, blue first; rows from the bottom, without gaps.
    const uint32_t* layer = nullptr;
    glm::ivec2 layerSize{0}; // at least 2 x 2
    glm::mat3 eyeFromEnv{1};
    glm::vec2 rayScale{1}, rayShift{0};   // half extent and centre of the layer's image plane at distance 1
    std::optional<CameraUniforms> filmed; // empty: the layer is painted unchanged, without scattered light
    const ImageRgbF* scattered = nullptr; // squares of display values, lat-long
};

// Paints the layer over texels low to high - 1 of a frame without gaps: a tile of FrameTiles, so small that
// rays are nearly linear within it.
void paintTexels(const TexelPaint& paint, const glm::ivec2& low, const glm::ivec2& high,
                 const glm::ivec2& frameSize, uint32_t* frame);

} // namespace shoal::render
