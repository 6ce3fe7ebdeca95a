// Estimates the response of a video's camera and codec from its frames: blur, noise, levels and glare.
// Values are display-coded, 0 to 1; lengths are texels of the frame at its equator.
//
// Buffers are reused, and grow only for a frame with more edges or blocks. One thread at a time.
#pragma once

#include "engine/core/Image.h"
#include "engine/light/FrameView.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace shoal::camera {

constexpr int kBrightnesses = 8; // bands of luma, evenly from 0 to 1

struct CameraResponse {
    // Standard deviation of the Gaussian blur of the sharpest edges, beyond a box filter of one texel.
    float blur_texels = 0;

    // Standard deviation of luma's noise by band of brightness. Fine: of single texels; coarse: of means over
    // 2 x 2 texels, beyond the contribution of fine noise.
    std::array<float, kBrightnesses> fineNoise{}, coarseNoise{};

    glm::vec3 black{0}, white{1}; // 0.1 and 99.9 % quantiles of each channel

    // Fraction of the light that port and lens scatter by some degrees; see Glare.
    float glare = 0;

    glm::ivec2 chromaTexels{1}; // chroma subsampling, horizontal and vertical: 2, 2 is 4:2:0
};

// Estimated response; the counts tell how reliable it is.
struct CameraResponseEstimate {
    CameraResponse response{.chromaTexels = glm::ivec2(2)}; // chroma is not estimated: the caller sets it
    int edges = 0;                                          // edges measured; below kFewEdges blur is 0
    // Blocks without clipped texels. A band with fewer than kFewBlocks copies the nearest band with enough.
    std::array<int, kBrightnesses> unclippedBlocks{};
};

constexpr int kFewEdges = 12;
constexpr int kFewBlocks = 8; // with fewer blocks in a band, even the flattest probably shows texture

class CameraResponseEstimator {
  public:
    // Reads five stripes (8 % of 2048 x 1024) of the frame's middle half, where a texel is at most 1.4 times
    // as high as wide. For the levels, reads one texel in 64 of the middle three quarters.
    CameraResponseEstimate estimate(const light::FrameView& frame);

  private:
    void readStripe(const light::FrameView& frame, int top);
    void measureEdges(float stretch);
    void measureBlur(CameraResponseEstimate& out);
    void measureNoise(CameraResponseEstimate& out);

    // The current stripe, row by row. Luma is 0 to 255; clipped tells whether any channel is clipped.
    int width_ = 0;
    std::vector<float> luma_;
    std::vector<unsigned char> clipped_;

    struct Blocks {
        std::vector<float> fine, coarse; // standard deviations
    };
    struct Edge {
        float blur_texels;
        float step; // of 255
    };
    std::vector<Edge> edges_;
    std::vector<float> blurs_; // scratch
    std::array<Blocks, kBrightnesses> blocks_;
};

constexpr int kGlareWidth = 128, kGlareHeight = 64; // cells of the lat-long map
constexpr int kCellSamples = 16;

// Veiling glare: port and lens scatter a fraction of the surrounding light to every texel, most visibly to
// dark objects in front of bright ones (ISO 9358). It must be added to virtual objects.
struct Glare {
    // The frame's light, blurred with a standard deviation of five degrees. Squared display values stand for
    // light, which is close enough to any camera's coding.
    ImageRgbF spread{kGlareWidth, kGlareHeight};
    // Upper bound of the fraction that the lens scatters, measured at the darkest texels in bright
    // surroundings; 1 if no bright texels are seen.
    float maxShare = 1;
};

class GlareFilter {
  public:
    void make(const light::FrameView& frame, Glare& out);

  private:
    ImageRgbF cells_{kGlareWidth, kGlareHeight}, across_{kGlareWidth, kGlareHeight};
    std::vector<std::array<float, kCellSamples>> samples_; // scratch
    std::vector<float> shares_, smallShares_;              // scratch
};

// Temporal smoothing of estimates. Deterministic: depends only on the estimates and the times between them.
class CameraResponseOverTime {
  public:
    // Takes the estimate of the frame now shown; dt_s: since the last call. The first is used directly, later
    // ones with a time constant of 2.2 seconds: cameras are not changed in mid-dive. A frame with fewer than
    // kFewEdges edges leaves the blur as it is; noise and levels follow every frame.
    void follow(const CameraResponseEstimate& estimate, float dt_s);

    // Upper bound of the glare from one frame: the minimum of all frames counts. While no frame gives a
    // useful bound, a typical lens is assumed.
    void followGlare(float maxShare, float dt_s);

    const CameraResponse& response() const { return response_; } // has no effect before the first estimate

  private:
    float maxGlare_ = 1;
    bool glareSeen_ = false;
    bool begun_ = false, edgesSeen_ = false;
    CameraResponse response_;
};

} // namespace shoal::camera
