// A body that bends, seen anew whenever it has bent far: exact where it was built, and dear.
#pragma once

#include "tests/baselines/occlusion/TracedOllfb.h"

#include <span>

namespace shoal::occlusion {

// How far a body has bent: the furthest any position is from where it was. Metres, body frame, so that
// swimming along does not count. Equally many of each.
float bend_m(std::span<const glm::vec3> now, std::span<const glm::vec3> before);

class RebuiltOllfb {
  public:
    // maxBend_m: 0 rebuilds whenever anything has moved.
    RebuiltOllfb(const TracedOllfb::Options& options, float maxBend_m)
        : options_(options), maxBend_m_(maxBend_m) {}

    // Shows the posed mesh; whether it was built anew. On an error the last one stays. Same number of
    // positions every time.
    Result<bool> follow(const BodyMesh& posed);

    std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction, float nearest) const {
        return ollfb_ ? ollfb_->trace(origin, direction, nearest) : std::nullopt;
    }
    size_t bytes() const { return (ollfb_ ? ollfb_->bytes() : 0) + built_.size() * sizeof(glm::vec3); }

  private:
    TracedOllfb::Options options_;
    float maxBend_m_;
    std::vector<glm::vec3> built_; // positions that ollfb_ was made of
    std::optional<TracedOllfb> ollfb_;
};

static_assert(TracesRays<RebuiltOllfb> && KeepsMemory<RebuiltOllfb>);

} // namespace shoal::occlusion
