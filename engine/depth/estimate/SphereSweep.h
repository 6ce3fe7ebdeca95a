// Distances of one frame from several others whose poses are known: a sweep of spheres around its camera. For
// each of a series of distances the other frames are sampled where they would show what is so far off; the
// distance at which they look most like the frame, and neighbouring texels agree (semi-global matching,
// Hirschmueller 2008), is taken. What moves or glitters in one or two of the frames counts little.
#pragma once

#include "engine/core/Hidden.h"
#include "engine/depth/estimate/StereoDepth.h"
#include "engine/light/FrameView.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace shoal::depth {

// Grey values less their local mean, over their local deviation: alike in any exposure.
struct SweepImage {
    std::vector<float> values; // lat-long, kSweepWidth around, padded left and right; a row more at the end
    // Deviation within three pixels over that of the large window, without padding: little of it is beside an
    // edge, and has nothing of its own.
    std::vector<float> detail;
};
constexpr int kSweepWidth = 512, kSweepHeight = kSweepWidth / 2;

void makeSweepImage(const light::FrameView& film, SweepImage& out);

struct SweepView {
    const SweepImage* image;
    glm::mat3 fromReference; // rotation of directions
    glm::vec3 at;            // of its camera, in the reference's axes
    bool isLater;
};

class SphereSweep {
  public:
    SphereSweep();
    // Inverse distances are of the unit that the views' places are in, from 0 to maxInverse. width of the
    // map: half of kSweepWidth.
    void estimate(const SweepImage& reference, std::span<const SweepView> views, float maxInverse,
                  DepthEstimate& out);

  private:
    struct Impl;
    Hidden<Impl> impl_;
};

} // namespace shoal::depth
