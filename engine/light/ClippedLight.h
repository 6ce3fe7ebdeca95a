// How bright the light was that the camera clipped: a sun or a window is white in a frame of 8 bits, and may
// have been a thousand times that. What the ground sends back tells how much light comes from above.
#pragma once

#include "engine/light/FrameView.h"

#include <cstdint>

namespace shoal::light {

// Assumes that the frame is a lat-long of a whole surround, its +Y up, and decodes sRGB. Three steps:
//   1. The mean radiance of the unclipped ground, by pi over an albedo of 0.18, is the irradiance from above.
//   2. What unclipped pixels do not supply of it is the clipped pixels' above the horizon: that many times
//      white they are.
//   3. Grounds differ in albedo by more than ten: the result is the weighed geometric mean of that gain and
//      of one that serves where there is no ground to be seen (covered, black, clipped).
// Only what is white in all three channels is scaled, and only above the horizon: what is clipped below it is
// mostly ground in the sun, and not far above white. Error by pictures with known light:
// tests/bench/figures/chart.md.
class ClippedLight {
  public:
    static constexpr float kGroundAlbedo = 0.18f;
    static constexpr float kUsualGain = 4; // of clipped pixels in a scene of which nothing is known
    static constexpr float kTrust = 0.4f;  // of the ground, an exponent; 1 - kTrust: of the usual gain
    static constexpr float kMostFromGround = 80;

    // Reads every kStep-th pixel of every kStep-th row.
    explicit ClippedLight(const FrameView& frame);

    // White stands for so many times white: 1 to mostGain().
    float gain() const { return gain_; }
    static float mostGain();

    // What a pixel's radiance is to be multiplied with, less 1, in this row of the frame if it is wholly
    // clipped; 0: nothing is scaled there.
    float rowGain(int row) const;
    // What a pixel's radiance is to be multiplied with in a row of this gain. pixel: three coded channels.
    static float scaleOf(float rowGain, const uint8_t* pixel);

  private:
    static constexpr int kStep = 4;
    float gain_ = 1;
    int height_ = 0;
};

} // namespace shoal::light
