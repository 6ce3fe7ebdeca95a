// The inner loops of the light: from coded pixels to radiance and means over 4 x 4 of them in one go. The
// rest of a frame's light is made of a sixteenth of its pixels.
//
// In whole numbers of 16 bits, twice as many a register as floats: every processor gives the same bits.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <span>

namespace shoal::light {

// Ways to the same result.
enum class BlockLoop {
    Plain, // any processor
    Avx2,  // 16 pixels at a time
};

bool canRun(BlockLoop loop); // on this processor
BlockLoop fastestBlockLoop();

// By radianceFromDisplay(), which is met within 2e-4 of itself; a step of 8 bits is twenty times that and
// more.
//
// out: frame.width / 4 x frame.height / 4, linear radiance. rowWeights: one for each row of the frame, each
// above 0, summing to 1 over the four of a block; their proportions are kept to 2^-15 of the largest. Width
// and height: multiples of 4.
void makeBlockMeans(const FrameView& frame, std::span<const float> rowWeights, ImageRgbF& out,
                    BlockLoop loop = fastestBlockLoop());

// By decoding sRGB: met within 2e-4 of white, and within 1 % of itself from coded 10 on, where a step of 8
// bits is 10 % (below that: 6 %).
//
// clipped, of the size of `out`: means of the pixels' clippedSteps() over kClippedSteps (ClippedLight.h)
// times their row's clippedWeights, 0 to 1 each. Rows of blocks that have none above 0 are left as they are;
// no weights: all.
void makeLinearBlockMeans(const FrameView& frame, std::span<const float> rowWeights,
                          std::span<const float> clippedWeights, ImageRgbF& out, ImageF& clipped,
                          BlockLoop loop = fastestBlockLoop());

} // namespace shoal::light
