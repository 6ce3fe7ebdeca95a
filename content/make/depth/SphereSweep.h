// Distances in one frame, found from several other frames with known poses by a sweep of spheres around its
// camera. For each of a series of distances, the other frames are sampled where they would show a point that
// far away. The sweep takes the distance at which they look most like the frame and neighbouring texels agree
// (semi-global matching, Hirschmueller 2008). Things that move or glitter in one or two of the frames count
// little.
#pragma once

#include "content/make/depth/StereoDepth.h"
#include "engine/core/Hidden.h"
#include "engine/light/FrameView.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace shoal::depth {

// Grey values minus their local mean, divided by their local deviation: the same in any exposure.
struct SweepImage {
    std::vector<float> values; // lat-long, kSweepWidth around, padded left and right; a row more at the end
    // Deviation within three pixels divided by that of the large window, without padding. It is small beside
    // an edge, at a place that has no detail of its own.
    std::vector<float> detail;
};
constexpr int kSweepWidth = 512, kSweepHeight = kSweepWidth / 2;

void makeSweepImage(const light::FrameView& film, SweepImage& out);

struct SweepView {
    const SweepImage* image;
    glm::mat3 fromReference; // rotation of directions
    glm::vec3 at;            // its camera, in the reference's axes
    bool isLater;
};

class SphereSweep {
  public:
    SphereSweep();
    // Inverse distances are from 0 to maxInverse, in one over the unit of SweepView::at. The map is
    // kSweepWidth / 2 texels wide.
    void estimate(const SweepImage& reference, std::span<const SweepView> views, float maxInverse,
                  DepthEstimate& out);

  private:
    struct Impl;
    Hidden<Impl> impl_;
};

} // namespace shoal::depth
