// Estimates the radiance of light that the camera clipped: a sun or a window is white in an 8-bit frame, and
// may have been a thousand times that. The light that the ground reflects tells how much came from above.
//
// The frame must be a lat-long map of the whole sphere, +Y up, in decoded sRGB. The method has three steps:
//   1. The irradiance from above is estimated as the mean radiance of the unclipped ground times pi over its
//      albedo. Patches far brighter than the rest are clamped: a beam of light on a cave's floor does not
//      come from the part of the sky that the frame shows.
//   2. The part of it that unclipped pixels do not supply must come from clipped pixels above the horizon: it
//      sets their gain, how many times white they are. The gain is lower where few pixels are clipped, so
//      that light does not flicker with the last of them. ClippedDensity weights the clipped pixels.
//   3. Albedos of grounds differ by a factor of more than ten, so the final gain is the weighted geometric
//      mean of that gain and a usual gain, which serves alone where no ground is visible (covered, black,
//      clipped). The higher clipped light stands, the more the ground's gain counts: light from the side, as
//      through windows or from a bright horizon, falls mostly on walls and slopes.
// The radiance added to a pixel's decoded radiance is
//     (gain(row) - 1) * clippedShare(row) * density(pixel) * clippedSteps(pixel) / kClippedSteps * tint
// above the horizon only: clipped pixels below it are mostly sunlit ground, not far above white. The tint is
// the cast that the whole picture and its brightest unclipped parts share, as under water; a white sun in a
// blue sky stays white. tests/bench/figures/chart.md has the errors for pictures with known light. The
// constants minimise the error over 42 public HDR pictures in three exposures each, except that
// kFewClipped is chosen so that the light of our films is steady.
#pragma once

#include "engine/core/Image.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shoal::light {

constexpr float kGroundAlbedo = 0.1f;
constexpr float kUsualGain = 2.5f; // gain of clipped pixels in an unknown scene
constexpr float kMaxFromGround = 300;

// In compressed video white is not exactly 255. A channel therefore counts as clipped gradually, from 243 to
// 255, so that pixels do not flicker. A pixel with only two clipped channels counts an eighth of one with
// all three, because it is less bright.
constexpr int kLastUnclipped = 243, kClippedSteps = 8 * (255 - kLastUnclipped);

// Returns how clipped a pixel is, 0 to kClippedSteps. pixel: three coded channels.
inline int clippedSteps(const uint8_t* pixel) {
    const int low = std::min(pixel[0], pixel[1]), high = std::max(pixel[0], pixel[1]);
    const int least = std::min<int>(low, pixel[2]), middle = std::max(low, std::min<int>(high, pixel[2]));
    return 7 * std::max(0, least - kLastUnclipped) + std::max(0, middle - kLastUnclipped);
}

// Returns the share of the gain that a row gets: 0 at the horizon and below, 1 from 9 degrees above it.
float clippedShare(int row, int height);

// Returns the irradiance of a level plane, facing up or down towards the row, by a texel of radiance 1 in it.
double levelIrradiance(int row, int width, int height);

// The density of a clipped pixel is the share of its surroundings that is clipped too: nearly 1 inside a sun,
// a lamp or a window, a few hundredths at glints on waves or gaps between leaves, hardly brighter than white.
//
// The upper half of a lat-long frame is divided into cells of 1.4 degrees; a cell's density is the mean over
// 3 x 3 cells, wider along rows near the pole. A light that moves across cells keeps its density.
class ClippedDensity {
  public:
    // Begins a frame. Allocates nothing while the size stays.
    void begin(int width, int height);
    // Adds a row at the horizon or above it. clipped: `width` values, 0 to 1.
    void addRow(int y, const float* clipped);
    void finish(); // after the last row

    // Multiplies a row's values by their densities; returns their sum.
    float weigh(int y, float* clipped) const;

  private:
    size_t cellRow(int y) const { return static_cast<size_t>(y) * rows_ / static_cast<size_t>(height_); }

    int width_ = 0, height_ = 0;        // of the frame
    size_t columns_ = 0, rows_ = 0;     // of cells, on the whole sphere
    std::vector<int> starts_;           // first pixel of each cell in a row, and the last one's end
    std::vector<int> counts_;           // by row of cells: rows of the frame in it
    std::vector<char> anything_;        // by row of cells: whether anything is clipped in it
    std::vector<float> sums_, density_; // columns_ x rows_
    std::vector<float> across_;         // scratch: columns_ x rows_
};

// Gain of clipped pixels: their radiance, as a multiple of white.
struct ClippedGain {
    float byGround = kUsualGain; // 1 to 1 + kMaxFromGround
    float seen = 0;              // visible ground as a share of the ground needed, at most 1

    float at(float sine) const; // of the elevation
    float of(int row, int height) const;
};

// Returns the gain of a frame. decoded: the whole sphere, at any resolution. clippedIrradiance: of a level
// plane, by the clipped pixels above it, taken as white and weighted by shares, densities and steps.
ClippedGain clippedGainOf(const ImageRgbF& decoded, double clippedIrradiance);

// Returns the tint of clipped light, with luminance 1; white without nearly white texels. decoded: as above.
glm::vec3 clippedTintOf(const ImageRgbF& decoded);

} // namespace shoal::light
