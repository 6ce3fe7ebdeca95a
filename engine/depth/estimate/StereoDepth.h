// Distances from the two pictures of an omnidirectional stereo film.
#pragma once

#include "engine/core/Hidden.h"
#include "engine/light/FrameView.h"

#include <vector>

namespace shoal::depth {

struct DepthEstimate {
    std::vector<float> inverse;    // lat-long; 1/m, or in units of one over the baseline
    std::vector<float> confidence; // 0 to 1, of the same size
};

class StereoDepth {
  public:
    StereoDepth();
    // For the left eye's picture. width: of the map, 2:1.
    void estimate(const light::FrameView& left, const light::FrameView& right, double baseline_m, int width,
                  DepthEstimate& out);

  private:
    struct Impl;
    Hidden<Impl> impl_;
};

} // namespace shoal::depth
