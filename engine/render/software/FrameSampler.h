// Bilinear samples of a frame in memory, 8 pixels at a time with AVX2: 1.3 ns a pixel where llvmpipe's
// texture unit takes 6.
#pragma once

#include "engine/render/View.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace shoal::render {

// A cell of a picture, pixels low to high - 1. first: the place in the frame that the middle of pixel `low`
// shows, in texels from the middle of the frame's first; right, up: steps to the next pixels, in texels.
struct SampledCell {
    glm::ivec2 low{0}, high{0};
    glm::vec2 first{0}, right{0}, up{0};
};

bool canSampleFrames(); // on this processor

// Returns whether all texels that the cell needs lie within the frame.
bool isWithin(const DisplayFrame& frame, const SampledCell& cell);

// Samples a cell that is within the frame, bilinearly, with errors of at most 1 / 255. picture: the pixel at
// (0, 0), channels as the frame's; stride: from row y to y + 1, in pixels.
void sampleCell(const DisplayFrame& frame, const SampledCell& cell, uint32_t* picture, ptrdiff_t stride);

} // namespace shoal::render
