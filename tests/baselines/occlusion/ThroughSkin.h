// A body that bends, asked in its rest pose: rays are bent instead of the body. Nothing is rebuilt but a
// coarse grid that says, for each place in the posed body, where it was at rest.
#pragma once

#include "tests/baselines/occlusion/TracedOllfb.h"

#include <span>

namespace shoal::occlusion {

class ThroughSkin {
  public:
    static constexpr int kCells = 16; // of the grid along the body's longest side
    static constexpr int kPieces = 8; // straight ones that a ray is bent into

    // rest: of the same body, in the frame of restPositions; must outlive this.
    ThroughSkin(const TracedOllfb& rest, std::span<const glm::vec3> restPositions)
        : rest_(&rest), restPositions_(restPositions.begin(), restPositions.end()) {
        bend(restPositions_);
    }

    // Takes the pose. As many positions as at rest, in their order, finite. Allocates only when the grid must
    // grow.
    void bend(std::span<const glm::vec3> posedPositions);

    std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction, float nearest) const;

    // Of the posed body; what a ray must meet.
    const Sphere& sphere() const { return sphere_; }
    // The grid's and the rest positions'; the buffers are shared by all bodies of their kind.
    size_t bytes() const {
        return grid_.size() * sizeof(glm::vec4) + restPositions_.size() * sizeof(glm::vec3);
    }
    // Where a place in the posed body was at rest.
    glm::vec3 restFromPosed(const glm::vec3& place) const;

  private:
    const TracedOllfb* rest_;
    std::vector<glm::vec3> restPositions_;
    Sphere sphere_;
    glm::vec3 low_{0};
    float perMetre_ = 1;
    glm::ivec3 size_{0};
    std::vector<glm::vec4> grid_, spread_; // xyz: displacement to rest; w: 1 where known
};

static_assert(TracesRays<ThroughSkin> && KeepsMemory<ThroughSkin>);

} // namespace shoal::occlusion
