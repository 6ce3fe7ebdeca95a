// The inner loop of the light: inverse tone mapping and means over 4 x 4 pixels in one go, for processors
// with AVX2. The other 97 % of a frame's light are done with a sixteenth of its pixels.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <span>

namespace shoal::light {

bool canMakeBlockMeans(); // on this processor

// out: frame.width / 4 x frame.height / 4, linear radiance by radianceFromDisplay(). rowWeights: one for each
// row of the frame, summing to 1 over the four of a block. Width and height: multiples of 4.
void makeBlockMeans(const FrameView& frame, std::span<const float> rowWeights, ImageRgbF& out);

} // namespace shoal::light
