// Distances found from the two pictures of an omnidirectional stereo film.
#pragma once

#include "engine/core/Hidden.h"
#include "engine/light/FrameView.h"

#include <vector>

namespace shoal::depth {

struct DepthEstimate {
    std::vector<float> inverse;    // inverse distances, lat-long; 1/m, or one over the baseline
    std::vector<float> confidence; // 0 to 1, of the same size
};

class StereoDepth {
  public:
    StereoDepth();
    // Finds the distances in the left eye's picture. width: of the map, which is half as high.
    void estimate(const light::FrameView& left, const light::FrameView& right, double baseline_m, int width,
                  DepthEstimate& out);

  private:
    struct Impl;
    Hidden<Impl> impl_;
};

} // namespace shoal::depth
