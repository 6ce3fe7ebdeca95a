#include "engine/light/InverseToneMap.h"

#include <gtest/gtest.h>

namespace shoal::light {
namespace {

TEST(InverseToneMap, ThesisValues) {
    EXPECT_EQ(radianceFromDisplay(glm::vec3(0)), glm::vec3(0));
    EXPECT_NEAR(radianceFromDisplay(glm::vec3(1)).x, 11.8f, 1e-5);
    // Eq. 4.1 by hand: L = 0.5, L' = 10 / 1024 + 1.8.
    EXPECT_NEAR(radianceFromDisplay(glm::vec3(0.5f)).y, (10.0 / 1024 + 1.8) * 0.5, 1e-6);
}

// Newton's last step is quadratic: what is left is rounding, some 2^-22; 1e-5 is a 400th of an 8-bit step.
TEST(InverseToneMap, MirrorShowsTheVideosOwnColours) {
    float worst = 0;
    for (int r = 0; r < 256; r += 3)
        for (int g = 0; g < 256; g += 3)
            for (int b = 0; b < 256; b += 3) {
                const glm::vec3 colour = glm::vec3(r, g, b) / 255.0f;
                const glm::vec3 error = displayFromRadiance(radianceFromDisplay(colour)) - colour;
                worst = std::max({worst, std::abs(error.x), std::abs(error.y), std::abs(error.z)});
            }
    EXPECT_LT(worst, 1e-5f);
}

TEST(InverseToneMap, BrighterThanWhiteStaysInOrder) {
    float before = 0;
    for (float y = 0.01f; y < 1e5f; y *= 1.3f) {
        const float shown = displayFromRadiance(glm::vec3(y)).x;
        EXPECT_GT(shown, before);
        EXPECT_NEAR(radianceFromDisplay(glm::vec3(shown)).x, y, 1e-4f * y);
        before = shown;
    }
}

} // namespace
} // namespace shoal::light
