#include "tests/baselines/occlusion/RebuiltOllfb.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace shoal::occlusion {

float bend_m(std::span<const glm::vec3> now, std::span<const glm::vec3> before) {
    assert(now.size() == before.size());
    float furthest2 = 0;
    for (size_t i = 0; i < now.size(); ++i) {
        const glm::vec3 moved = now[i] - before[i];
        furthest2 = std::max(furthest2, glm::dot(moved, moved));
    }
    return std::sqrt(furthest2);
}

Result<bool> RebuiltOllfb::follow(const BodyMesh& posed) {
    if (ollfb_ && bend_m(posed.positions, built_) <= maxBend_m_) return false;
    auto made = TracedOllfb::make(posed, options_);
    if (!made) return made.error();
    ollfb_ = std::move(*made);
    built_.assign(posed.positions.begin(), posed.positions.end());
    return true;
}

} // namespace shoal::occlusion
