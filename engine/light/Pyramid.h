// Makes the radiance pyramid of a frame: inverse tone mapping, resampling and halving, weighted by exact
// solid angles.
#pragma once

#include "engine/light/ClippedLight.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/FrameView.h"
#include "engine/light/InverseToneMap.h"

#include <vector>

namespace shoal::light {

// Largest radiance taken from a picture; larger values are clamped, NaN and negative ones become 0. The sun's
// disc has 5 * 10^4 where a sunlit white wall has 1, and 10^9 in cd/m^2. Sums of products do not overflow.
constexpr float kMaxRadianceIn = 1e9f;

// The largest half float. Infinities become this: they come from pictures that store the sun in half floats.
constexpr float kMaxHalf = 65504.0f;

constexpr int kMinBaseWidth = 256; // smaller sources are enlarged, so that every step has the levels it needs

// Width of level 0 for a source: the largest power of two not above sourceWidth and askedWidth, at least
// kMinBaseWidth.
int baseWidthFor(int sourceWidth, int askedWidth);

// Halves width and height; each texel is the mean of four weighted by their solid angles. in: width = 2
// height, a power of two >= 4.
void halve(const ImageRgbF& in, ImageRgbF& out);

// Makes pyramids; keeps its tables and rows between calls, so nothing is allocated while sizes stay. One
// thread at a time.
class PyramidMaker {
  public:
    // Makes the pyramid of a frame of any width and height that shows the whole sphere. Pixels are averaged
    // only after inverse tone mapping (InverseToneMap.h). Auto: see ClippedLight.h.
    void make(const FrameView& frame, int askedWidth, RadiancePyramid& out,
              FrameRadiance from = FrameRadiance::Thesis);

    // Takes linear radiance.
    void make(const ImageRgbF& radianceLin, int askedWidth, RadiancePyramid& out);

    // Returns the gain of the last frame made with FrameRadiance::Auto.
    const ClippedGain& clippedGain() const { return clippedGain_; }

  private:
    // A weight of resampling: target row or column `to` gets `weight` times source row or column `from`.
    struct Share {
        int from = 0, to = 0;
        float weight = 0;
    };
    template <class Edge> static std::vector<Share> sharesOf(int source, int target, Edge&& edge);

    bool makeByBlocks(const FrameView& frame, int askedWidth, RadiancePyramid& out, FrameRadiance from);
    void makeBlocks(const FrameView& frame, ImageRgbF& blocks, FrameRadiance from);
    void prepare(int sourceWidth, int sourceHeight, int askedWidth, RadiancePyramid& out);
    template <class DecodeRow> void addRows(DecodeRow&& decodeRow, ImageRgbF& base);
    template <class ClippedRow>
    glm::vec3 measureClipped(int width, int height, const ImageRgbF& decoded, ClippedRow&& clippedRow);
    void addClipped(const FrameView& frame, ImageRgbF& base);
    const float* narrowRow();

    int sourceWidth_ = 0, sourceHeight_ = 0, baseWidth_ = 0;
    std::vector<Share> rows_, columns_;   // ascending by `from` and `to`
    std::vector<float> blockRows_;        // weights for makeBlockMeans()
    std::vector<float> clippedShares_;    // by row of a frame: clippedShare()
    ImageRgbF blocks_;                    // result of makeBlockMeans(), unless that is the base itself
    ImageF clippedBlocks_;                // the same for clipped pixels
    ClippedDensity density_;              // density of clippedBlocks_
    std::vector<float> row_, clippedRow_; // one source row, linear; clipped shares of its pixels
    std::vector<float> narrow_;           // the row at the base's width
    ClippedGain clippedGain_;
};

} // namespace shoal::light
