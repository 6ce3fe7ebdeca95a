// Bilinear samples of a frame in memory, 8 pixels at a time with AVX2: 1.3 ns a pixel where llvmpipe's
// texture unit takes 6.
#pragma once

#include "engine/render/View.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace shoal::render {

// Of a picture, low to high - 1 in pixels. In texels, 0 at the middle of the frame's first: what the middle
// of pixel low shows, and how far that is from one pixel to the next.
struct SampledCell {
    glm::ivec2 low{0}, high{0};
    glm::vec2 first{0}, right{0}, up{0};
};

bool canSampleFrames(); // on this processor

// Whether all that the cell shows, with the texels beside it, is within the frame.
bool isWithin(const DisplayFrame& frame, const SampledCell& cell);

// Bilinear, within 1 / 255 of exact. picture: the pixel at (0, 0), channels as the frame's; stride: in
// pixels, from row y to y + 1. The cell is within the frame.
void sampleCell(const DisplayFrame& frame, const SampledCell& cell, uint32_t* picture, ptrdiff_t stride);

} // namespace shoal::render
