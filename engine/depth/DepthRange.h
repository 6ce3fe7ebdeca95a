// How near and how far off a film is within a part of it, without a look at every texel: whether it can hide
// an object at all, or hides it wholly.
#pragma once

#include "engine/depth/DepthMap.h"

#include <glm/vec2.hpp>

#include <vector>

namespace shoal::depth {

class DepthRange {
  public:
    struct Range {
        float min_perM = 0, max_perM = 0; // of inverse distances
    };

    // Allocates nothing once it has been made of a map of that size.
    void make(const DepthMap& map);

    // Of what lies within this angle of a direction, and a little around it. dirEnv: unit length.
    Range around(const glm::vec3& dirEnv, float halfAngle) const;

  private:
    static constexpr glm::ivec2 kCells{64, 32};

    struct Codes {
        uint8_t min = 255, max = 0;
    };
    std::vector<Codes> cells_;
    std::vector<uint8_t> columnMin_, columnMax_; // scratch: over the rows of a cell
};

} // namespace shoal::depth
