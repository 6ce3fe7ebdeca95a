// Diffuse methods against light whose answer has a closed form.
#include "engine/light/Pyramid.h"
#include "tests/baselines/light/Baselines.h"
#include "tests/baselines/light/Harmonics.h"
#include "tests/unit/light/Environments.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace shoal::light::baselines {
namespace {

const std::vector<glm::vec3> kNormals = [] {
    std::vector<glm::vec3> normals = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}};
    for (const float y : {-0.8f, -0.3f, 0.4f, 0.9f})
        for (const float turn : {0.3f, 1.9f, 3.1f, 5.0f})
            normals.emplace_back(std::sqrt(1 - y * y) * std::sin(turn), y,
                                 std::sqrt(1 - y * y) * std::cos(turn));
    return normals;
}();

// Largest difference of the red light from what is wanted of each normal.
double farthest(DiffuseMethod method, const ImageRgbF& environment,
                const std::function<double(const glm::dvec3&)>& want) {
    RadiancePyramid pyramid;
    PyramidMaker maker;
    maker.make(environment, environment.width, pyramid);
    method.update(Input{&pyramid, {}, &environment});
    std::vector<glm::vec3> got(kNormals.size());
    method.shade(kNormals, got);
    double worst = 0;
    for (size_t i = 0; i < got.size(); ++i)
        worst = std::max(worst, std::abs(static_cast<double>(got[i].x) - want(glm::dvec3(kNormals[i]))));
    return worst;
}

// Sums over texels' centres are off by the square of their size: 0.6 % for 16x8, a quarter of it for each
// doubling. Harmonics are integrated over whole texels; what is left is rounding. The Gaussians are a least
// squares fit.
double furnaceTolerance(const Label& label) {
    const double parts = label.family == "brute force" ? std::stoi(label.brief) / 16.0 : 1;
    if (label.family == "brute force") return 0.008 / (parts * parts);
    if (label.family == "spherical Gaussians") return 5e-4;
    return 2e-6;
}

TEST(DiffuseBaselines, WhiteFurnace) {
    const ImageRgbF white = uniform(256, glm::dvec3(1));
    for (const DiffuseMethod& method : diffuseMethods())
        EXPECT_LT(farthest(method, white, [](auto&) { return 1.0; }), furnaceTolerance(method.label))
            << method.label.name;
}

TEST(DiffuseBaselines, NamesAreUniqueAndOneIsTheDefault) {
    int defaults = 0, theses = 0;
    const auto methods = diffuseMethods();
    for (const DiffuseMethod& method : methods) {
        EXPECT_EQ(1, std::count_if(
                         methods.begin(), methods.end(),
                         [&](const DiffuseMethod& other) { return other.label.name == method.label.name; }))
            << method.label.name;
        defaults += method.label.role == Role::Default;
        theses += method.label.role == Role::Thesis;
    }
    EXPECT_EQ(defaults, 1);
    EXPECT_EQ(theses, 1);
}

// A matte surface keeps two thirds of the first band: radiance 1 + 0.8 a.d gives 1 + 0.8 (2/3) a.n, which two
// bands hold whole. Means over texels weaken the gradient by (pi / 64)^2 / 12 = 2e-4 across and down
// together.
TEST(DiffuseBaselines, HarmonicsAreExactForALinearGradient) {
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0, -0.8)}) {
        const auto gradient =
            paint(256, 128, [&](auto& d) { return glm::dvec3(1 + 0.8 * glm::dot(axis, d)); });
        const auto want = [&](const glm::dvec3& n) { return 1 + 0.8 * 2 / 3 * glm::dot(axis, n); };
        for (const int bands : {2, 3, 4, 6, 8})
            EXPECT_LT(farthest(harmonicDiffuse(bands, false), gradient, want), 3e-4) << bands;
        EXPECT_LT(farthest(zonalHarmonicsDiffuse(), gradient, want), 3e-4);
        // One band holds the mean alone, a window lowers the gradient.
        EXPECT_GT(farthest(harmonicDiffuse(1, false), gradient, want), 0.4);
        EXPECT_GT(farthest(harmonicDiffuse(2, true), gradient, want), 0.05);
    }
}

// White where a.d > 0: (1 + a.n) / 2. The edge lies between texels; what is left goes with the square of
// their size, as in the furnace.
TEST(DiffuseBaselines, BruteForceFindsAHemispheresClosedForm) {
    const auto half = paint(256, 128, [](auto& d) { return glm::dvec3(d.y > 0); });
    const auto want = [](const glm::dvec3& n) { return (1 + n.y) / 2; };
    for (const auto& [width, tolerance] : {std::pair(128, 1e-4), {64, 6e-4}, {32, 1.5e-3}, {16, 5e-3}})
        EXPECT_LT(farthest(bruteForce(width), half, want), tolerance) << width;
}

// Light that is symmetric around an axis: ZH3 drops nothing of its third band.
TEST(DiffuseBaselines, Zh3KeepsASymmetricThirdBand) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -2));
    const auto lobe = paint(256, 128, [&](auto& d) {
        const double c = glm::dot(axis, d);
        return glm::dvec3(1 + c + c * c);
    });
    // Bands of 1 + c + c^2: 4/3, c, (3 c^2 - 1) / 3; kept: 1, 2/3, 1/4.
    const auto want = [&](const glm::dvec3& n) {
        const double c = glm::dot(axis, n);
        return 4.0 / 3 + 2.0 / 3 * c + 0.25 * (c * c - 1.0 / 3);
    };
    EXPECT_LT(farthest(zonalHarmonicsDiffuse(), lobe, want), 5e-4);
    EXPECT_LT(farthest(harmonicDiffuse(3, false), lobe, want), 5e-4);
}

// A sky with a bright patch ten texels across: more of anything is nearer to the truth.
TEST(DiffuseBaselines, MoreIsNearer) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(3, 1, 2));
    const double reach = std::cos(0.2);
    const auto sky =
        paint(256, 128, [&](auto& d) { return glm::dvec3(glm::dot(axis, d) > reach ? 20.0 : 0.2); });
    const Lobe lobes[] = {diffuseLobe()};
    const auto truth = [&](const glm::dvec3& n) { return referenceRadiance(sky, n, lobes)[0].x; };
    double before = 1e30;
    for (const int lobesCount : {12, 24, 48}) {
        const double now = farthest(sphericalGaussians(lobesCount), sky, truth);
        EXPECT_LT(now, 0.75 * before) << lobesCount << " Gaussians";
        before = now;
    }
    before = 1e30;
    for (const int bands : {2, 3, 6, 8}) {
        const double now = farthest(harmonicDiffuse(bands, false), sky, truth);
        EXPECT_LT(now, 0.85 * before) << bands << " bands";
        before = now;
    }
}

// Addition theorem: the squares of a band's harmonics sum to (2 l + 1) / 4 pi in every direction.
TEST(Harmonics, SquaresOfABandSumUp) {
    const Harmonics harmonics(kMaxBands);
    std::array<float, kMaxHarmonics> values{};
    for (const glm::vec3& dir : kNormals) {
        harmonics.evaluate(dir, values);
        for (int l = 0; l < kMaxBands; ++l) {
            double sum = 0;
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                const auto value = static_cast<double>(values[static_cast<size_t>(i)]);
                sum += value * value;
            }
            EXPECT_NEAR(sum, (2 * l + 1) / (4 * std::numbers::pi), 2e-6 * (2 * l + 1)) << "band " << l;
        }
    }
}

// Ramamoorthi and Hanrahan 2001, eq. 8 and 9, over pi.
TEST(Harmonics, CosineLobesFactors) {
    const auto factors = zonalFactors(diffuseLobe(), 6);
    const double want[] = {1, 2.0 / 3, 1.0 / 4, 0, -1.0 / 24, 0};
    for (size_t l = 0; l < factors.size(); ++l) EXPECT_NEAR(factors[l], want[l], 1e-6) << "band " << l;
}

} // namespace
} // namespace shoal::light::baselines
