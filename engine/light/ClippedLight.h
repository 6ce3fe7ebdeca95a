// How bright the light was that the camera clipped: a sun or a window is white in a frame of 8 bits, and may
// have been a thousand times that. What the ground sends back tells how much light comes from above.
//
// The frame is taken for a lat-long of a whole surround, its +Y up, of decoded sRGB. Three steps:
//   1. The mean radiance of the unclipped ground, by pi over its albedo, is the irradiance from above.
//      Patches far brighter than the rest are cut: a beam that falls on a cave's floor does not come from
//      where its sky is seen.
//   2. What unclipped pixels do not supply of it is the clipped pixels' above the horizon: that many times
//      white they are; fewer the less is clipped, so that light does not come and go with the last pixels.
//      Light that is clipped all around counts most (ClippedDensity.h).
//   3. Grounds differ in albedo by more than ten: the gain is the weighed geometric mean of that and of one
//      that serves where there is no ground to be seen (covered, black, clipped). The higher clipped light
//      stands, the more the ground tells of it: what comes from the side, as through windows and from a
//      bright horizon, falls on walls and slopes first.
// The radiance added to a pixel's decoded radiance is
//     (gain(row) - 1) * clippedShare(row) * density(pixel) * clippedSteps(pixel) / kClippedSteps * tint
// above the horizon only: clipped pixels below it are mostly ground in the sun, not far above white. The
// tint is what the whole of the picture and its brightest parts that are not white have in common, as under
// water: a white sun in a blue sky is white. Error by pictures with known light:
// tests/bench/figures/chart.md. The constants are those that bring 42 public HDR pictures, none of them on
// that chart, in three exposures each nearest to their light; how few clipped pixels are few, those that
// make the light of our films steady.
#pragma once

#include "engine/core/Image.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>

namespace shoal::light {

constexpr float kGroundAlbedo = 0.1f;
constexpr float kUsualGain = 2.5f; // of clipped pixels in a scene of which nothing is known
constexpr float kMaxFromGround = 300;

// The exponent of the ground's gain, 0.1 at the horizon to 1 at the zenith; the rest to 1 is the usual
// gain's. sine: of the elevation of clipped light.
float groundTrust(float sine);

// Video is compressed: white is not 255 everywhere. From 243 to 255 a channel counts as clipped more and
// more, so that none flickers between the two. A pixel of which two channels are clipped, and which is less
// bright than where all are, counts an eighth.
constexpr int kLastUnclipped = 243, kClippedSteps = 8 * (255 - kLastUnclipped);

// 0 to kClippedSteps. pixel: three coded channels.
inline int clippedSteps(const uint8_t* pixel) {
    const int low = std::min(pixel[0], pixel[1]), high = std::max(pixel[0], pixel[1]);
    const int least = std::min<int>(low, pixel[2]), middle = std::max(low, std::min<int>(high, pixel[2]));
    return 7 * std::max(0, least - kLastUnclipped) + std::max(0, middle - kLastUnclipped);
}

// How much of the gain holds in a row: from 0 at the horizon, and below, to 1 at an elevation of 9 degrees.
float clippedShare(int row, int height);

// Irradiance of a level plane, facing up or down as the row lies, by a texel of radiance 1 in this row.
double levelIrradiance(int row, int width, int height);

// How many times white clipped pixels are.
struct ClippedGain {
    float byGround = kUsualGain; // 1 to 1 + kMaxFromGround
    float seen = 0;              // 0 to 1: as far as there is ground to tell it

    float at(float sine) const; // of the elevation
    float of(int row, int height) const;
};

// decoded: the whole surround, averaged over as few pixels or as many as is convenient. clippedIrradiance: of
// a level plane from above, by clipped pixels if they were white, by their shares, densities and steps.
ClippedGain clippedGainOf(const ImageRgbF& decoded, double clippedIrradiance);

// The colour of clipped light, of luminance 1. decoded: as above. White where nothing is nearly white.
glm::vec3 clippedTintOf(const ImageRgbF& decoded);

} // namespace shoal::light
