// The inner loop of the light: inverse tone mapping and means over 4 x 4 pixels in one go. The rest of a
// frame's light is made of a sixteenth of its pixels.
//
// In whole numbers of 16 bits, twice as many a register as floats: every processor gives the same bits.
// radianceFromDisplay() is met within 2e-4 of itself; a step of 8 bits is twenty times that and more.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <span>

namespace shoal::light {

// Ways to the same result.
enum class BlockLoop {
    Plain,  // any processor
    Avx2,   // 16 pixels at a time
    Avx512, // 32; with VBMI and VNNI
};

bool canRun(BlockLoop loop); // on this processor
BlockLoop fastestBlockLoop();

// out: frame.width / 4 x frame.height / 4, linear radiance. rowWeights: one for each row of the frame, each
// above 0, summing to 1 over the four of a block; their proportions are kept to 2^-15 of the largest. Width
// and height: multiples of 4.
void makeBlockMeans(const FrameView& frame, std::span<const float> rowWeights, ImageRgbF& out,
                    BlockLoop loop = fastestBlockLoop());

} // namespace shoal::light
