#include "engine/physics/Grip.h"
#include "engine/core/Random.h"
#include "engine/physics/ContactModel.h"
#include "tests/Test.h"

namespace shoal::physics {
namespace {

// Directions are refined to 0.01 rad; forces of 10 N then err by up to 0.1 N.
constexpr float kTol_N = 0.1f;

Press press(glm::vec3 normal, float force_N) { return {glm::normalize(normal), force_N}; }

TEST(Hold, NothingHoldsNothing) {
    EXPECT_EQ(hold({}, glm::vec3(0)).margin_N, 0);
    EXPECT_LT(hold({}, {0, -1, 0}).margin_N, -0.9f);
}

TEST(Hold, OneSideAloneHoldsNothingHoweverHardItPresses) {
    const std::vector<Press> palm = {press({0, -1, 0}, 100), press({0.2f, -1, 0}, 100),
                                     press({0, -1, 0.2f}, 100)};
    EXPECT_LE(hold(palm, glm::vec3(0)).margin_N, 0);
}

// Two opposed fingers of force F. Along d, at an angle a from their line, they give F (cos a + mu sin a), and
// from tan a = 1 / mu on 2 mu F sin a, both by friction. The least is at that angle: sin a = 1 / sqrt(1 +
// mu^2).
TEST(Hold, TwoOpposedFingersHoldAsTheClosedFormSays) {
    const float force = 10, edge = 1 / std::sqrt(1 + kFriction * kFriction);
    const std::vector<Press> pinch = {press({1, 0, 0}, force), press({-1, 0, 0}, force)};
    EXPECT_NEAR(hold(pinch, glm::vec3(0)).margin_N, 2 * kFriction * force * edge, kTol_N);
    // Pulled across their line: friction less the pull.
    EXPECT_NEAR(hold(pinch, {0, 6, 0}).margin_N, (2 * kFriction * force - 6) * edge, 2 * kTol_N);
    const Hold slips = hold(pinch, {0, 12, 0});
    EXPECT_NEAR(slips.margin_N, 2 * kFriction * force - 12, kTol_N);
    EXPECT_GT(slips.gives.y, 0.98f) << "it slips the way it is pulled";
}

// Nguyen 1988: two fingers close when the line between them lies in both cones of friction.
TEST(Hold, TwoFingersCloseWhileTheirAngleIsWithinBothCones) {
    const float cone = std::atan(kFriction);
    for (float askew : {0.0f, 0.5f * cone, 0.9f * cone, 1.1f * cone, 2 * cone}) {
        // Both lean the same way from the line that joins them.
        const std::vector<Press> pinch = {press({std::cos(askew), std::sin(askew), 0}, 10),
                                          press({-std::cos(askew), std::sin(askew), 0}, 10)};
        const float margin = hold(pinch, glm::vec3(0)).margin_N;
        EXPECT_EQ(margin > kTol_N, askew < cone) << askew / cone << ": " << margin;
    }
}

// The search over directions against twenty thousand of them.
TEST(Hold, FindsTheWorstDirection) {
    Random random(7, 1);
    const auto unit = [&] {
        for (;;) {
            const glm::vec3 v(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
            const float squared = glm::dot(v, v);
            if (squared > 0.01f && squared < 1) return v / std::sqrt(squared);
        }
    };
    for (int round = 0; round < 60; ++round) {
        std::vector<Press> presses;
        const int count = 2 + static_cast<int>(random.below(12));
        for (int i = 0; i < count; ++i) presses.push_back({unit(), random.between(0.2f, 4)});
        const glm::vec3 asked = unit() * random.between(0, 4);
        const Hold found = hold(presses, asked);
        float truth = 1e9f;
        for (int i = 0; i < 20'000; ++i) {
            const glm::vec3 d = unit();
            float sum = glm::dot(asked, d);
            for (const Press& p : presses) {
                const float along = glm::dot(p.normal, d);
                sum += p.force_N *
                       std::max(0.0f, along + kFriction * std::sqrt(std::max(0.0f, 1 - along * along)));
            }
            truth = std::min(truth, sum);
        }
        float squeeze_N = 0;
        for (const Press& p : presses) squeeze_N += p.force_N;
        EXPECT_GT(found.margin_N, truth - 0.02f * (squeeze_N + 1)) << round;
        EXPECT_LT(found.margin_N, truth + 0.05f * (squeeze_N + 1)) << round;
    }
}

TEST(Hold, ForcesAreBounded) {
    EXPECT_EQ(pressForce_N(-1), 0);
    EXPECT_EQ(pressForce_N(100), kForceMax_N);
    EXPECT_NEAR(pressForce_N(0.004f), 0.004f * kStiffness_Npm, 1e-6f);
    // A sphere of 3 cm.
    EXPECT_NEAR(mass_kg(0.03f, 0), kDensity_kgpm3 * 1.131e-4f, 1e-4f);
}

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
        const float closed = glm::distance(wrapped(bent(angle), fish(0.024f)).joints[4], bent(0).joints[4]);
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
