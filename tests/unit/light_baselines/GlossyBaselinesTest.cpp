// Glossy methods keep uniform light, are right in smooth light, and agree whether they filter maps or gather.
#include "engine/light/Lookup.h"
#include "engine/light/Pyramid.h"
#include "tests/baselines/light/Baselines.h"
#include "tests/baselines/light/FittedTaps.h"
#include "tests/baselines/light/Reference.h"
#include "tests/baselines/light/Taps.h"
#include "tests/unit/light/Environments.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shoal::light::baselines {
namespace {

const std::vector<glm::vec3> kDirs = [] {
    std::vector<glm::vec3> dirs = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
    for (const float y : {-0.9f, -0.2f, 0.5f})
        for (const float turn : {0.3f, 1.9f, 3.1f})
            dirs.emplace_back(std::sqrt(1 - y * y) * std::sin(turn), y,
                              std::sqrt(1 - y * y) * std::cos(turn));
    return dirs;
}();

RadiancePyramid pyramidOf(const ImageRgbF& environment) {
    RadiancePyramid pyramid;
    PyramidMaker maker;
    maker.make(environment, environment.width, pyramid);
    return pyramid;
}

TEST(GlossyBaselines, WhiteFurnace) {
    const ImageRgbF white = uniform(256, glm::dvec3(0.25, 1, 3));
    const RadiancePyramid pyramid = pyramidOf(white);
    std::vector<glm::vec3> got(kDirs.size());
    for (const GlossyMethod& method : glossyMethods()) {
        method.update(Input{&pyramid, {}, &white});
        // Weights are scaled to sum to 1; harmonics are sums of 8192 products in floats.
        const double tolerance = method.label.family == "spherical harmonics" ? 1e-4 : 2e-5;
        for (const float roughness : {0.1f, 0.2f, 0.35f, 0.6f, 0.9f, 1.0f}) {
            method.shade(kDirs, roughness, got);
            for (const glm::vec3& each : got)
                EXPECT_LT(glm::length(each - glm::vec3(0.25f, 1, 3)), tolerance)
                    << method.label.name << ", roughness " << roughness;
        }
    }
}

double rmsOnGradient(const GlossyMethod& method, float roughness) {
    const auto sky = paint(256, 128, [](auto& d) { return glm::dvec3(1 + 0.5 * d.y + 0.4 * d.x * d.z); });
    const RadiancePyramid pyramid = pyramidOf(sky);
    method.update(Input{&pyramid, {}, &sky});
    std::vector<glm::vec3> got(kDirs.size());
    method.shade(kDirs, roughness, got);
    const Lobe lobes[] = {glossyLobe(static_cast<double>(roughness))};
    double squares = 0;
    for (size_t i = 0; i < kDirs.size(); ++i) {
        const double off = static_cast<double>(got[i].x) -
                           referenceRadiance(sky, glm::normalize(glm::dvec3(kDirs[i])), lobes)[0].x;
        squares += off * off;
    }
    return std::sqrt(squares / static_cast<double>(kDirs.size()));
}

// The rest is the width of the texels read, which 64 samples leave an eighth of a radian apart.
TEST(GlossyBaselines, ImportanceSamplingConverges) {
    for (const float roughness : {0.4f, 0.7f, 1.0f}) {
        const double few = rmsOnGradient(filteredImportanceSampling(8), roughness);
        const double many = rmsOnGradient(filteredImportanceSampling(64), roughness);
        const double more = rmsOnGradient(filteredImportanceSampling(1024), roughness);
        EXPECT_LT(many, 0.5 * few) << roughness;
        EXPECT_LT(many, 0.02) << roughness;
        EXPECT_LT(more, 0.003) << roughness;
    }
}

TEST(GlossyBaselines, EachMeetsASmoothSkyAtWideLobes) {
    for (const GlossyMethod& method : glossyMethods()) {
        if (method.label.brief == "FIS 8" || method.label.brief == "FIS 16") continue; // too noisy
        for (const float roughness : {0.6f, 1.0f})
            EXPECT_LT(rmsOnGradient(method, roughness), 0.03) << method.label.name << ", " << roughness;
    }
}

TEST(Taps, WeightsSumToOneAndNoneIsNegative) {
    for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f})
        for (const auto& taps : {ggxTaps(roughness, 32, 1024), fittedTaps(roughness, 1024)}) {
            double sum = 0;
            for (const Tap& tap : taps) {
                EXPECT_GT(tap.weight, 0);
                EXPECT_NEAR(static_cast<double>(glm::length(tap.local)), 1, 1e-6);
                sum += static_cast<double>(tap.weight);
            }
            EXPECT_NEAR(sum, 1, 1e-5);
        }
}

// Rows share their taps' places: every texel must be as if gathered alone, at the seam and the poles too.
// Floats hold a place among 256 columns to 1e-5 of a texel; noise changes by up to 1 from texel to texel. The
// map ends at the pole's row where lookUp() goes on beyond it.
TEST(Taps, FilteredMapIsWhatGatheringGives) {
    const RadiancePyramid pyramid = pyramidOf(noise(256, 128));
    const std::vector<Tap> taps = {{glm::normalize(glm::vec3(0.3f, 0.1f, 1)), 0.0f, 0.5f},
                                   {glm::normalize(glm::vec3(-0.7f, 0.6f, 1)), 1.3f, 0.3f},
                                   {{0, 0, 1}, 4.0f, 0.2f}};
    ImageRgbF map;
    TapFilter(taps, 32, 256).apply(pyramid, map);
    ASSERT_EQ(map.width, 32);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) {
            const glm::dvec3 axis = texelDirection<double>(x, y, 32, 16);
            const glm::dvec3 east = glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0)));
            const glm::dvec3 north = glm::cross(east, axis);
            glm::vec3 want(0);
            for (const Tap& tap : taps) {
                const glm::dvec3 local(tap.local);
                want +=
                    tap.weight *
                    lookUp(pyramid, glm::vec3(east * local.x + north * local.y + axis * local.z), tap.lod);
            }
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(map.at(x, y)[c], want[c], y == 0 || y == 15 ? 5e-3f : 2e-3f) << x << ", " << y;
        }
}

} // namespace
} // namespace shoal::light::baselines
