// Rays that are reflected from mirror to mirror.
#include "tests/baselines/occlusion/Mirror.h"

#include <gtest/gtest.h>

namespace shoal::occlusion {
namespace {

// The planes y = 0 and y = 1, mirrors that face each other.
struct Corridor {
    std::optional<Hit> trace(const glm::vec3& o, const glm::vec3& d, float) const {
        if (d.y == 0) return {};
        const bool up = d.y > 0;
        return Hit{((up ? 1.0f : 0.0f) - o.y) / d.y, {0, up ? -1 : 1, 0}};
    }
};

TEST(Mirror, BouncesAsOftenAsAllowed) {
    const glm::vec3 direction = glm::normalize(glm::vec3(3, 4, 0));
    for (const int maximum : {0, 1, 2, 8}) {
        const Reflected end = followMirrors(Corridor{}, {0, 0.5f, 0}, direction, 1e-3f, maximum);
        EXPECT_EQ(end.bounces, maximum);
        EXPECT_TRUE(end.caught);
        // Every bounce turns y; the way to the nth is n - 1/2 high, three quarters of that long.
        EXPECT_NEAR(end.direction.y, maximum % 2 ? -0.8f : 0.8f, 1e-6f);
        if (maximum) {
            EXPECT_NEAR(end.origin.x, 0.75f * (static_cast<float>(maximum) - 0.5f), 1e-5f);
        }
    }
    const Reflected free = followMirrors(Corridor{}, {0, 0.5f, 0}, {1, 0, 0}, 0, 8);
    EXPECT_EQ(free.bounces, 0);
    EXPECT_FALSE(free.caught);
}

} // namespace
} // namespace shoal::occlusion
