#include "engine/physics/Grip.h"

#include "engine/physics/ContactModel.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace shoal::physics {
namespace {

// Returns an index finger along -z, 8 mm above the origin, bent towards -y by `angle` at each knuckle, rad.
Finger bent(float angle) {
    Finger f;
    const float length[] = {0, 0.067f, 0.045f, 0.027f, 0.023f};
    f.joints[0] = {0, 0.008f, 0.03f};
    f.radii = {0, 0.0105f, 0.009f, 0.008f, 0.0065f};
    float a = 0;
    for (int i = 1; i < hands::kMaxFingerJoints; ++i) {
        if (i > 1) a += angle;
        f.joints[i] = f.joints[i - 1] + glm::vec3(0, -std::sin(a), -std::cos(a)) * length[i];
    }
    return f;
}

// A fish across the palm, below the knuckle.
Capsule fish(float radius) {
    return {{-0.03f, -0.006f - radius, -0.03f}, {0.03f, -0.006f - radius, -0.03f}, radius};
}

float gap(const Finger& f, const Capsule& body) {
    float minimum = 1;
    for (int i = 2; i < f.count; ++i)
        minimum = std::min(minimum, separation({f.joints[i - 1], f.joints[i], f.radii[i]}, body));
    return minimum;
}

TEST(Finger, AFingerThatMeetsNothingStaysAsItIs) {
    const Finger given = bent(0.9f);
    const Finger out = wrapped(given, {{5, 0, 0}, {5, 0, 0}, 0.02f});
    for (int i = 0; i < hands::kMaxFingerJoints; ++i) {
        EXPECT_NEAR(glm::distance(out.joints[i], given.joints[i]), 0, 1e-6f);
        EXPECT_FALSE(out.touches[i]);
        EXPECT_NEAR(std::fabs(out.turned[i].w), 1, 1e-5f);
    }
}

TEST(Finger, WrapsAroundAFishWithoutEnteringItAndKeepsItsBones) {
    for (float radius : {0.02f, 0.025f, 0.03f})
        for (float angle : {0.6f, 0.9f, 1.2f, 1.5f}) {
            const Finger given = bent(angle), out = wrapped(given, fish(radius));
            EXPECT_GT(gap(out, fish(radius)), -1e-4f) << radius << " " << angle;
            int touching = 0;
            for (int i = 1; i < hands::kMaxFingerJoints; ++i) {
                EXPECT_NEAR(glm::distance(out.joints[i], out.joints[i - 1]),
                            glm::distance(given.joints[i], given.joints[i - 1]), 1e-6f);
                touching += out.touches[i];
            }
            EXPECT_GE(touching, angle > 1 ? 2 : 0) << radius << " " << angle;
        }
}

TEST(Finger, AFistsTipComesRoundToTheFarSide) {
    const Finger out = wrapped(bent(1.4f), fish(0.024f));
    // The last bone lies beyond the fish's equator, so it presses the fish up to the palm.
    ASSERT_TRUE(out.touches[4]);
    const glm::vec3 middle = 0.5f * (out.joints[3] + out.joints[4]);
    EXPECT_LT(middle.y, fish(0.024f).a.y);
}

TEST(Finger, ClosesSteadily) {
    float before = 0;
    for (float angle = 0; angle < 1.5f; angle += 0.02f) {
        const Finger out = wrapped(bent(angle), fish(0.024f));
        const float closed = glm::distance(out.joints[4], bent(0).joints[4]);
        EXPECT_GT(closed, before - 1e-3f) << angle; // tolerance where the next knuckle takes over
        EXPECT_LT(closed - before, 0.02f) << "no jump at " << angle;
        before = closed;
    }
}

TEST(Finger, OddFingersComeToNoHarm) {
    Finger curled = bent(3.14159f), point;
    point.joints.fill(glm::vec3(0.01f));
    for (const Finger& given : {curled, point}) {
        const Finger out = wrapped(given, fish(0.024f));
        for (const glm::vec3& joint : out.joints) EXPECT_TRUE(std::isfinite(joint.x + joint.y + joint.z));
    }
}

} // namespace
} // namespace shoal::physics
