// The inner loops of the light: decode pixels to radiance and average blocks of 4 x 4 in one go. The rest of
// a frame's light is made of a sixteenth of its pixels.
//
// They compute with whole numbers of 16 bits, twice as many a register as floats: every processor gives the
// same bits.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <span>

namespace shoal::light {

// Implementations with the same result.
enum class BlockLoop {
    Plain, // any processor
    Avx2,  // 16 pixels at a time
};

bool canRun(BlockLoop loop); // on this processor
BlockLoop fastestBlockLoop();

// Decodes by radianceFromDisplay(), within a relative 2e-4; a step of 8 bits is at least twenty times that.
//
// out: frame.width / 4 x frame.height / 4, linear radiance. rowWeights: one for each row of the frame, each
// above 0, summing to 1 over the four of a block; their proportions are kept to 2^-15 of the largest. Width
// and height: multiples of 4.
void makeBlockMeans(const FrameView& frame, std::span<const float> rowWeights, ImageRgbF& out,
                    BlockLoop loop = fastestBlockLoop());

// Decodes sRGB, within 2e-4 of white, and within a relative 1 % from coded 10 on, where a step of 8 bits is
// 10 % (below that: 6 %).
//
// clipped, of the size of `out`: means of the pixels' clippedSteps() over kClippedSteps (ClippedLight.h)
// times their row's clippedWeights, 0 to 1 each. Rows of blocks without a weight above 0 keep their values;
// without clippedWeights all do.
void makeLinearBlockMeans(const FrameView& frame, std::span<const float> rowWeights,
                          std::span<const float> clippedWeights, ImageRgbF& out, ImageF& clipped,
                          BlockLoop loop = fastestBlockLoop());

} // namespace shoal::light
