// Multiplies a frame's texels by shadows, on the processor. Twin of shaders/render/Background with SHADED.
#pragma once

#include "engine/core/Image.h"
#include "engine/render/View.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace shoal::render {

// Writes texels low to high - 1 of the frame, multiplied by `left` (FilmShadows::left(), interpolated
// linearly), into `out`, whose rows are outStride texels apart.
void shadeTexels(const DisplayFrame& frame, const Image<uint8_t, 4>& left, const glm::ivec2& low,
                 const glm::ivec2& high, uint32_t* out, ptrdiff_t outStride);

} // namespace shoal::render
