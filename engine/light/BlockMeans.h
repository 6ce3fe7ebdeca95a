// Decodes pixels to radiance and averages blocks of 4 x 4 pixels in one pass. All later steps of making light
// work on these means, a sixteenth of the number of pixels.
//
// The loops compute with 16-bit integers: a register holds twice as many of them as floats, and every
// processor gives the same bits.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"
#include "engine/light/InverseToneMap.h"

#include <span>

namespace shoal::light {

// Implementations with the same result.
enum class BlockLoop {
    Plain, // any processor
    Avx2,  // 16 pixels at a time
};

bool canRun(BlockLoop loop); // on this processor
BlockLoop fastestBlockLoop();

// Thesis: decodes as radianceFromDisplay() does, with a relative error of at most 2e-4; neighbouring coded
// values differ by 0.4 % or more. Linear and Auto: decode sRGB. The error is at most 2e-4 of white; relative
// to the value it is at most 1 % from coded 10 on, where an 8-bit step is 10 %, and 6 % below.
//
// out: frame.width / 4 x frame.height / 4, linear radiance. rowWeights: one for each row of the frame,
// above 0. The weights of the four rows of a block count relative to their sum; each is rounded to 2^-15 of
// the largest. Width and height of the frame: multiples of 4.
//
// clipped: for Auto, of the same size as `out`; gets each block's mean of clippedSteps() / kClippedSteps
// times the row's weight in clippedWeights, 0 to 1 (ClippedLight.h). Rows of blocks whose clippedWeights are
// all 0 are not written.
void makeBlockMeans(const FrameView& frame, FrameRadiance from, std::span<const float> rowWeights,
                    ImageRgbF& out, BlockLoop loop, std::span<const float> clippedWeights = {},
                    ImageF* clipped = nullptr);

} // namespace shoal::light
