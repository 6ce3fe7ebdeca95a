#include "engine/math/LatLong.h"
#include "tests/baselines/HarmonicSums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace shoal::math {
namespace {

using std::numbers::pi;

ImageRgbF paint(int width, const std::function<double(const glm::dvec3&)>& radiance) {
    ImageRgbF image(width, width / 2);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 uv((x + 0.5) / width, (y + 0.5) / image.height);
            const auto value = static_cast<float>(radiance(directionFromLatLong(uv)));
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = value;
        }
    return image;
}

TEST(LatLong, DirectionsAndTexelsAgree) {
    EXPECT_NEAR(directionFromLatLong(glm::dvec2(0.5, 0.5)).z, -1.0, 1e-15);
    EXPECT_NEAR(directionFromLatLong(glm::dvec2(0.75, 0.5)).x, 1.0, 1e-15);
    EXPECT_NEAR(directionFromLatLong(glm::dvec2(0.3, 0.0)).y, 1.0, 1e-15);
    for (const double u : {0.01, 0.3, 0.99})
        for (const double v : {0.01, 0.4, 0.97}) {
            const glm::dvec2 back = latLongFromDirection(directionFromLatLong(glm::dvec2(u, v)));
            EXPECT_NEAR(back.x, u, 1e-12);
            EXPECT_NEAR(back.y, v, 1e-12);
        }
    double sum = 0;
    for (int y = 0; y < 107; ++y) sum += texelSolidAngle(y, 214, 107) * 214;
    EXPECT_NEAR(sum, 4 * pi, 1e-12);
}

// The bound of the polynomial, 1e-5 radians, is 3.2e-6 of the map's height and half as much of its width.
TEST(LatLong, RoughTexelsAreOffByLittle) {
    for (int row = 0; row <= 200; ++row)
        for (int column = 0; column < 400; ++column) {
            const glm::vec2 uv((static_cast<float>(column) + 0.5f) / 400, static_cast<float>(row) / 200);
            const glm::vec3 dir = directionFromLatLong(uv);
            const glm::vec2 rough = latLongRoughly(dir);
            EXPECT_NEAR(rough.y, uv.y, 4e-6f) << uv.x << ", " << uv.y;
            // At the poles there is no longitude.
            if (row > 0 && row < 200) {
                EXPECT_NEAR(rough.x, uv.x, 4e-6f) << uv.x << ", " << uv.y;
            }
        }
    for (const float y : {-1.0f, 1.0f}) EXPECT_EQ(latLongRoughly(glm::vec3(0, y, 0)).y, y < 0 ? 1 : 0);
}

// Midpoint rule in latitude: (pi / 128)^2 / 24 relative on each of up to 8 powers of sine and cosine.
TEST(SphericalHarmonics, AreOrthonormal) {
    std::array<std::array<double, kShCount>, kShCount> gram{};
    constexpr int kWidth = 256, kHeight = 128;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const auto basis = shBasis(texelDirection<double>(x, y, kWidth, kHeight));
            for (size_t i = 0; i < kShCount; ++i)
                for (size_t j = 0; j < kShCount; ++j)
                    gram[i][j] += basis[i] * basis[j] * texelSolidAngle(y, kWidth, kHeight);
        }
    for (size_t i = 0; i < kShCount; ++i)
        for (size_t j = 0; j < kShCount; ++j)
            EXPECT_NEAR(gram[i][j], i == j ? 1.0 : 0.0, 1e-3) << i << " " << j;
}

// Float pixels: 6e-8 relative; the rest as above.
TEST(SphericalHarmonics, ProjectionReturnsWhatIsInTheBands) {
    const ShRgb c = shProject(paint(128, [](const glm::dvec3& d) { return 2 + d.y + 3 * d.x * d.z; }));
    for (const glm::dvec2 uv : {glm::dvec2(0.1, 0.2), glm::dvec2(0.6, 0.5), glm::dvec2(0.9, 0.9)}) {
        const glm::dvec3 d = directionFromLatLong(uv);
        EXPECT_NEAR(shEvaluate(c, d).x, 2 + d.y + 3 * d.x * d.z, 3e-3);
    }
}

// Ramamoorthi and Hanrahan 2001: uniform light stays, a linear gradient keeps 2/3, a quadratic one 1/4.
TEST(SphericalHarmonics, MatteSurfaceDampsEachBand) {
    const glm::dvec3 up(0, 1, 0);
    EXPECT_NEAR(shDiffuseRadiance(shProject(paint(128, [](const glm::dvec3&) { return 1.0; })), up, 5).x, 1,
                1e-3);
    EXPECT_NEAR(shDiffuseRadiance(shProject(paint(128, [](const glm::dvec3& d) { return d.y; })), up, 5).x,
                2.0 / 3, 1e-3);
    EXPECT_NEAR(shDiffuseRadiance(
                    shProject(paint(128, [](const glm::dvec3& d) { return 1.5 * d.y * d.y - 0.5; })), up, 5)
                    .x,
                0.25, 1e-3);
}

// A hemisphere of light: exactly (1 + cos) / 2. Nine coefficients miss at most 1 % of what a point light
// would give on the worst normal in theory's example; a half sphere's bands 4 and up are smaller yet.
TEST(SphericalHarmonics, HalfTheSkyLit) {
    const ShRgb c = shProject(paint(256, [](const glm::dvec3& d) { return d.y > 0 ? 1.0 : 0.0; }));
    for (const double angle : {0.0, 0.7, 1.5, 2.2, 3.0}) {
        const glm::dvec3 n(std::sin(angle), std::cos(angle), 0);
        EXPECT_NEAR(shDiffuseRadiance(c, n).x, 0.5 + 0.5 * std::cos(angle), 2e-3);
    }
}

} // namespace
} // namespace shoal::math
