// Rays followed from mirror to mirror.
#include "tests/baselines/occlusion/Mirror.h"
#include "Bodies.h"
#include "tests/baselines/occlusion/TracedOllfb.h"

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

TEST(Mirror, CuredLayersBounceAsTruthDoes) {
    const Body body = torus(1, 0.4f, 96, 48);
    const TracedOllfb cured = TracedOllfb::make(body.mesh()).value();
    struct Exact {
        const Body& body;
        std::optional<Hit> trace(const glm::vec3& o, const glm::vec3& d, float nearest) const {
            const auto hit = truth(body, o, d, static_cast<double>(nearest));
            if (!hit) return {};
            return Hit{static_cast<float>(hit->distance), hit->normal};
        }
    };
    // Into the ring from above: off the inner walls, once or more.
    Random random(8);
    int twice = 0, same = 0, all = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 from(random.between(-0.2f, 0.2f), 2, random.between(-0.2f, 0.2f));
        const glm::vec3 to(random.between(-0.8f, 0.8f), 0, random.between(-0.8f, 0.8f));
        const glm::vec3 d = glm::normalize(to - from);
        const Reflected exact = followMirrors(Exact{body}, from, d, 0.02f, 8);
        const Reflected ours = followMirrors(cured, from, d, 0.02f, 8);
        ++all, same += exact.bounces == ours.bounces, twice += exact.bounces >= 2;
    }
    std::printf("%d of %d with two bounces or more; %d as often as in truth\n", twice, all, same);
    EXPECT_GT(twice, 20);
    EXPECT_GE(same, all * 95 / 100);
}

} // namespace
} // namespace shoal::occlusion
