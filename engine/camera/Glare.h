// Veiling glare: the light that port and lens scatter over a frame, and an upper bound of the scattered
// fraction.
//
// Veiling glare adds a fraction of the surrounding light to every texel, most visibly to dark objects in
// front of bright ones (ISO 9358). Virtual objects need it added.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <vector>

namespace shoal::camera {

constexpr int kGlowWidth = 128, kGlowHeight = 64; // cells of the lat-long map

struct Glare {
    // Light blurred with a standard deviation of five degrees. Light is the square of display values, which
    // approximates any camera's coding well enough for this.
    ImageRgbF spread{kGlowWidth, kGlowHeight};
    // Upper bound of the fraction that the lens scatters, from the darkest texels in bright surroundings; 1
    // if no bright texels are seen.
    float maxShare = 1;
};

// Does not allocate after the first frame. One thread at a time.
class GlareFilter {
  public:
    void make(const light::FrameView& frame, Glare& out);

  private:
    ImageRgbF cells_{kGlowWidth, kGlowHeight}, across_{kGlowWidth, kGlowHeight};
    std::vector<float> shares_; // scratch
};

} // namespace shoal::camera
