// Objects in a frame's texels, on the processor. Twin of shaders/render/EquirectComposite.
#pragma once

#include "engine/core/Image.h"
#include "engine/render/EquirectComposite.h"
#include "engine/render/View.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace shoal::render {

// What is painted, and how.
struct TexelPaint {
    // The layer: display values, premultiplied, blue first; rows from the bottom, without gaps.
    const uint32_t* layer = nullptr;
    glm::ivec2 layerSize{0}; // at least 2 x 2
    glm::mat3 eyeFromEnv{1};
    glm::vec2 rayScale{1}, rayShift{0}; // half the layer's image plane's extent at distance 1; its centre
    // Null: the layer as it is, without those that follow.
    const CameraUniforms* filmed = nullptr;
    const uint8_t* grain = nullptr;       // makeGrain()
    const ImageRgbF* scattered = nullptr; // squares of display values, lat-long
};

// Needs canSampleFrames(). Texels low to high - 1 of the frame, with what is before them, into `out`,
// where a row begins outStride texels after the last. They are so few that rays are as good as linear among
// them: a tile of FrameTiles.
void paintTexels(const DisplayFrame& frame, const TexelPaint& paint, const glm::ivec2& low,
                 const glm::ivec2& high, uint32_t* out, ptrdiff_t outStride);

} // namespace shoal::render
