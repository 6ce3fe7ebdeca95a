// Estimate of the camera response from one frame of a video.
//
// Reads stripes of the frame's middle half, where texels are nearly square (8 % of 2048 x 1024), and for the
// levels one texel in 64. Does not allocate after the first frame of a size. One thread at a time.
#pragma once

#include "engine/camera/CameraResponse.h"
#include "engine/light/FrameView.h"

#include <vector>

namespace shoal::camera {

// Estimated response; the counts tell how reliable it is.
struct CameraResponseEstimate {
    CameraResponse response{.chromaTexels = glm::ivec2(2)}; // not estimated: 4:2:0, unless the decoder knows
    int edges = 0;                                          // edges measured; below kFewEdges blur is 0
    std::array<int, kBrightnesses> flatBlocks{}; // blocks measured for noise; a band without any takes its
                                                 // neighbour's noise
};

constexpr int kFewEdges = 12;
constexpr int kFewBlocks = 8; // of a band: fewer probably contain texture

class CameraResponseEstimator {
  public:
    CameraResponseEstimate estimate(const light::FrameView& frame);

  private:
    void readStripe(const light::FrameView& frame, int top);
    void measureEdges(float stretch);
    void measureBlur(CameraResponseEstimate& out);
    void measureNoise(CameraResponseEstimate& out);
    void measureLevels(const light::FrameView& frame, CameraResponse& response);

    // The current stripe, row by row: luma, 0 to 255; clipped: whether any channel is.
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

// Temporal smoothing of estimates. Deterministic: depends only on the estimates and the times between them.
class CameraResponseOverTime {
  public:
    // Takes the estimate of the frame now shown; dt_s: since the last call. The first is used directly, later
    // ones with a time constant of 2.2 seconds: cameras are not changed in mid-dive. Unknown values stay.
    void follow(const CameraResponseEstimate& estimate, float dt_s);

    // Upper bound of the glare from one frame (Glare.h): the minimum of all frames counts. While no frame
    // gives a useful bound, a typical lens is assumed.
    void followGlare(float maxShare, float dt_s);

    const CameraResponse& response() const { return response_; } // before the first estimate: no effect

  private:
    float maxGlare_ = 1;
    bool glareSeen_ = false;
    bool begun_ = false, edgesSeen_ = false;
    CameraResponse response_;
};

} // namespace shoal::camera
