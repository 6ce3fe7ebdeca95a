// Dense optical flow between two equirectangular frames. It runs on the faces of a cube, which have neither
// seam nor poles. Faces overlap, so that a point that crosses a cube's edge is still found in its first face.
#pragma once

#include "content/make/depth/RelativePose.h"
#include "engine/core/Hidden.h"
#include "engine/light/FrameView.h"

#include <array>
#include <cstdint>
#include <vector>

namespace shoal::depth {

constexpr int kFaceSize = 384; // pixels, of each side of a face: 0.43 degrees in its middle
constexpr float kFaceTan =
    1.45f; // tangent of half a face's field of view: 5 degrees and more beyond the edges

struct CubeFaces {
    std::array<std::vector<uint8_t>, 6> grey; // kFaceSize x kFaceSize each
};

// A point of the first frame, as it is found in the second.
struct FlowPoint {
    glm::vec3 second{0}; // direction, unit length
    float error_rad =
        1; // angle by which flow to the second frame and back misses the point; 1: no flow, or no contrast
};

class CubeFlow {
  public:
    CubeFlow();
    // film: one eye's picture.
    void makeFaces(const light::FrameView& film, CubeFaces& out);

    // Both results have one point for each texel of a lat-long map of that width: `there` is the flow from
    // the first frame to the second, `back` the flow from the second to the first.
    void match(const CubeFaces& first, const CubeFaces& second, int width, std::vector<FlowPoint>& there,
               std::vector<FlowPoint>& back);

  private:
    struct Impl;
    Hidden<Impl> impl_;
};

} // namespace shoal::depth
