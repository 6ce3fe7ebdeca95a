// What shadows leave of a frame's texels, on the processor. Twin of shaders/render/Background with SHADED.
#pragma once

#include "engine/core/Image.h"
#include "engine/render/View.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace shoal::render {

// Texels low to high - 1 of the frame, multiplied with `left` (FilmShadows has it), which is between its
// texels linear, into `out`, where a row begins outStride texels after the last.
void shadeTexels(const DisplayFrame& frame, const Image<uint8_t, 4>& left, const glm::ivec2& low,
                 const glm::ivec2& high, uint32_t* out, ptrdiff_t outStride);

} // namespace shoal::render
