#include "engine/math/Trigonometry.h"

#include <gtest/gtest.h>

namespace shoal::math {
namespace {

// Half a unit in the last place of a float just below 1, 2 and 4, and the series.
constexpr double kBelow1 = 3.0e-8 + 1e-9, kBelow4 = 1.2e-7 + 1e-9;

TEST(Trigonometry, SineAndCosineAgreeWithTheLibrarysToTheRoundingOfAFloat) {
    double worst = 0;
    for (int i = -400'000; i <= 400'000; ++i) {
        const float angle = static_cast<float>(i) * 1e-3f;
        const double exact = static_cast<double>(angle);
        worst = std::max({worst, std::fabs(static_cast<double>(sine(angle)) - std::sin(exact)),
                          std::fabs(static_cast<double>(cosine(angle)) - std::cos(exact))});
    }
    EXPECT_LE(worst, kBelow1);
    EXPECT_EQ(sine(0.0f), 0);
    EXPECT_EQ(cosine(0), 1);
    EXPECT_EQ(sine(-1.25f), -sine(1.25f));
}

TEST(Trigonometry, ArcTangentAgreesWithTheLibrarysInAllDirections) {
    double worst = 0;
    for (int i = -100'000; i <= 100'000; ++i) {
        const double angle = i * std::numbers::pi / 100'000;
        for (const double length : {1e-20, 1.0, 1e20}) {
            const float x = static_cast<float>(length * std::cos(angle));
            const float y = static_cast<float>(length * std::sin(angle));
            const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
            worst = std::max(worst, std::fabs(static_cast<double>(arcTangent(y, x)) - exact));
        }
    }
    EXPECT_LE(worst, kBelow4);
    EXPECT_EQ(arcTangent(0, 0), 0);
    EXPECT_EQ(arcTangent(0, 1), 0);
    EXPECT_FLOAT_EQ(arcTangent(0, -1), std::numbers::pi_v<float>);
}

// Near the ends rounding of the cosine itself is as much as the square root of a float's: the same for both.
TEST(Trigonometry, ArcCosineAgreesWithTheLibrarys) {
    for (int i = -100'000; i <= 100'000; ++i) {
        const float cosine = static_cast<float>(i) * 1e-5f;
        EXPECT_NEAR(arcCosine(cosine), std::acos(static_cast<double>(cosine)), 3e-7) << cosine;
    }
    EXPECT_EQ(arcCosine(1), 0);
    EXPECT_EQ(arcCosine(7), 0);
    EXPECT_FLOAT_EQ(arcCosine(-1), std::numbers::pi_v<float>);
}

TEST(Trigonometry, RotationsAreThoseOfGlm) {
    const glm::vec3 axis = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    for (const float angle : {-3.0f, -0.4f, 0.0f, 1e-3f, 1.5f, 3.1f}) {
        const glm::quat ours = rotationAbout(axis, angle), theirs = glm::angleAxis(angle, axis);
        EXPECT_NEAR(glm::length(glm::vec4(ours.x - theirs.x, ours.y - theirs.y, ours.z - theirs.z,
                                          ours.w - theirs.w)),
                    0, 2e-7);
    }
}

} // namespace
} // namespace shoal::math
