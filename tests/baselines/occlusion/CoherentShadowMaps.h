// A shadow map from each of many directions, compressed by their likeness. Ritschel, Grosch, Kautz and
// Mueller 2007, "Interactive Illumination with Coherent Shadow Maps": any depth between the first surface and
// the second casts the same shadow, so one value serves a pixel for as many successive directions as their
// intervals share.
#pragma once

#include "tests/baselines/occlusion/Fragments.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <cstdint>

namespace shoal::occlusion::baselines {

class CoherentShadowMaps {
  public:
    // Closed bodies, in the world. directions: light travels against them; any order, alike ones should
    // follow another.
    CoherentShadowMaps(std::span<const Triangles> bodies, std::span<const glm::vec3> directions, int size);

    // Whether a point on the surface of a body is occluded in the direction of this index.
    bool occluded(const glm::vec3& position, size_t direction) const;
    std::size_t bytes() const {
        return runs_.size() * sizeof(Run) + first_.size() * sizeof(uint32_t) + views_.size() * 12;
    }
    std::size_t plainBytes() const {
        return first_.size() * views_.size() * sizeof(uint16_t);
    } // uncompressed

  private:
    struct Run {
        uint16_t from = 0;  // direction that it begins with
        uint16_t depth = 0; // 0 the near end of the sphere, 65535 nothing there
    };
    std::vector<OrthoView> views_;
    std::vector<uint32_t> first_; // per pixel and one more
    std::vector<Run> runs_;
    float depthScale_ = 1;
};

// Directions along a spiral from pole to pole: each is near the one before.
std::vector<glm::vec3> spiralDirections(int count);

} // namespace shoal::occlusion::baselines
