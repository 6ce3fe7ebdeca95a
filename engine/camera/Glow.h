// The light that port and lens scatter over a frame, and how much of its own light a frame says they scatter.
//
// Veiling glare adds a share of the light around to everything that is filmed, most visibly to dark things in
// front of bright ones (ISO 9358). What stands before the video was never behind that glass.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <vector>

namespace shoal::camera {

constexpr int kGlowWidth = 128, kGlowHeight = 64; // cells of the lat-long map

struct Glow {
    // Mean light about each cell, with a standard deviation of five degrees: light is the square of display
    // values, which is near enough to any camera's coding for what is added faintly.
    ImageRgbF spread{kGlowWidth, kGlowHeight};
    // The lens scatters no more than this share: there is something before bright surroundings that is as
    // dark. 1 where nothing bright is seen.
    float mostShare = 1;
};

// Nothing is allocated once it has been used. One thread at a time.
class GlowMaker {
  public:
    void make(const light::FrameView& frame, Glow& out);

  private:
    ImageRgbF cells_{kGlowWidth, kGlowHeight}, across_{kGlowWidth, kGlowHeight};
    std::vector<float> shares_; // scratch
};

} // namespace shoal::camera
