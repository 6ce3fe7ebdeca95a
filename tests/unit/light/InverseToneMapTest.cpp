#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"
#include "tests/Test.h"

// The shaders' twin, in double precision.
namespace glsl {
namespace {
using vec3 = glm::dvec3;
using glm::clamp;
using glm::dot;
using glm::mix;
using glm::pow;
using glm::sqrt;
using glm::step;
using std::sqrt;
#define float double
#include "shaders/light/ToneCurve.glsl"
#undef float
} // namespace
} // namespace glsl

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
    for (int r = 0; r < 256; r += 3)
        for (int g = 0; g < 256; g += 3)
            for (int b = 0; b < 256; b += 3) {
                const glm::vec3 colour = glm::vec3(r, g, b) / 255.0f;
                const glm::vec3 shown = displayFromRadiance(radianceFromDisplay(colour));
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(shown[c], colour[c], 1e-5f);
            }
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

// Relative to what is displayed, so that it holds for every hue.
TEST(InverseToneMap, ShaderIsItsTwin) {
    double before = 0;
    for (double l = 1e-4; l < 3; l *= 1.0003) {
        const double y = 10 * std::pow(l, 11) + 1.8 * l;
        const double shown = glsl::displayFromRadiance(glm::dvec3(y)).x;
        EXPECT_NEAR(glsl::radianceFromDisplay(glm::dvec3(l)).x, y, 1e-12 * y);
        const double allowed = y < 11.8 ? 0.05 / 255 : y < 100 ? 0.25 / 255 : 0.5;
        EXPECT_NEAR(shown / l, 1, allowed) << l;
        EXPECT_GT(shown, before) << l;
        before = shown;
    }
    EXPECT_GT(before, 1);
}

// Steps of a 16th of a value of 8 bits, the straight part at black too. 0.18 / 255 is what the shader states.
TEST(InverseToneMap, ShaderCodesAsSrgb) {
    for (int i = 0; i <= 255 * 16; ++i) {
        const double coded = i / (255.0 * 16), linear = math::linearFromSrgb(coded);
        EXPECT_NEAR(glsl::linearFromSrgb(glm::dvec3(coded)).x, linear, 1e-12);
        EXPECT_NEAR(glsl::srgbFromLinear(glm::dvec3(linear)).x, coded, 0.18 / 255) << coded;
    }
    EXPECT_EQ(glsl::srgbFromLinear(glm::dvec3(-1, 0, 1e9)),
              glm::dvec3(0, 0, glsl::srgbFromLinear(glm::dvec3(1)).x));
    EXPECT_GT(glsl::srgbFromLinear(glm::dvec3(1)).x, 254.5 / 255); // white is white
}

} // namespace
} // namespace shoal::light
