// Nearest and farthest distance within a part of a film, found without reading every texel: tells whether the
// film can hide an object at all, or hides it fully.
#pragma once

#include "engine/depth/DepthMap.h"

#include <glm/vec2.hpp>

#include <vector>

namespace shoal::depth {

class DepthRange {
  public:
    struct Range {
        float min_perM = 0, max_perM = 0; // inverse distances
    };

    // Allocates only for a map of a new size.
    void make(const DepthMap& map);

    // Returns the range within this angle of a direction, and a little around it. dirEnv: unit length.
    Range around(const glm::vec3& dirEnv, float halfAngle) const;

  private:
    static constexpr glm::ivec2 kCells{64, 32};

    struct Codes {
        uint8_t min = 255, max = 0;
    };
    std::vector<Codes> cells_;
    std::vector<uint8_t> columnMin_, columnMax_; // scratch: extremes over the rows of a cell
};

} // namespace shoal::depth
