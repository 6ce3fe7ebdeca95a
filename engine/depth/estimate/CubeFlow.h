// Dense optical flow between two equirectangular frames. It runs on the faces of a cube, which have neither
// seam nor poles, each a little larger than a sixth of the sphere so that what moves stays in it.
#pragma once

#include "engine/core/Hidden.h"
#include "engine/depth/estimate/RelativePose.h"
#include "engine/light/FrameView.h"

#include <array>
#include <cstdint>
#include <vector>

namespace shoal::depth {

constexpr int kFaceSize = 384;    // pixels, of each side of a face: 0.43 degrees in its middle
constexpr float kFaceTan = 1.45f; // of half the field of view of a face: 5 degrees and more beyond the edges

struct CubeFaces {
    std::array<std::vector<uint8_t>, 6> grey; // kFaceSize x kFaceSize each
};

// Where points of the first frame are seen in the second.
struct FlowPoint {
    glm::vec3 second{0}; // direction, unit length
    float error_rad = 1; // by how much flow there and back do not meet; 1: no flow, or nothing to follow
};

class CubeFlow {
  public:
    CubeFlow();
    // Of one eye's picture.
    void makeFaces(const light::FrameView& film, CubeFaces& out);

    // For each texel of a lat-long map of that width: there, from the first frame to the second, and back.
    void match(const CubeFaces& first, const CubeFaces& second, int width, std::vector<FlowPoint>& there,
               std::vector<FlowPoint>& back);

  private:
    struct Impl;
    Hidden<Impl> impl_;
};

} // namespace shoal::depth
