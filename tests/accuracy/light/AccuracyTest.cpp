// Diffuse and glossy maps of real surrounds against the double-precision integrals over every texel.
#include "tests/accuracy/light/RadianceFile.h"

#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "engine/light/PhongRings.h"
#include "engine/light/Reference.h"
#include "engine/math/SphericalHarmonics.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

namespace shoal::light {
namespace {

Path hdrFolder() {
    const char* set = std::getenv("SHOAL_SHARED");
    return (set && *set ? Path(set) : Path(SHOAL_SOURCE_DIR) / ".." / "shared") / "data" / "hdr";
}

// Directions spread evenly over the sphere (Fibonacci lattice).
std::vector<glm::dvec3> directions(int count) {
    std::vector<glm::dvec3> result;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2 * i + 1.0) / count, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const double ring = std::sqrt(1 - y * y);
        result.emplace_back(ring * std::cos(turn), y, ring * std::sin(turn));
    }
    return result;
}

struct Error {
    double squares = 0, truth = 0;
    void add(const glm::dvec3& got, const glm::dvec3& want) {
        squares += glm::dot(got - want, got - want);
        truth += glm::dot(want, want);
    }
    double relative() const { return std::sqrt(squares / truth); }
};

struct Bounds {
    double diffuse, glossy;
};

// Relative root mean square errors over 200 directions, bilinear and trilinear lookups included. At roughness 0.5
// and 0.8 two levels are mixed, at the others one level stands alone.
class LightAccuracy : public testing::TestWithParam<const char*> {};

TEST_P(LightAccuracy, AgainstTheIntegral) {
    const auto surround = readRadianceFile(hdrFolder() / (std::string(GetParam()) + "_1k.hdr"));
    if (!surround) GTEST_SKIP() << "needs the reference data in " << hdrFolder();
    const std::vector<float> roughnesses = {0.1f, 0.2f, 0.35f, 0.5f, 0.6f, 0.8f, 1.0f};
    std::vector<Lobe> lobes = {diffuseLobe()};
    for (const float roughness : roughnesses) lobes.push_back(glossyLobe(roughness));

    EnvironmentLight video, still;
    LightMaker videoMaker({1024, LightQuality::Video}), stillMaker({1024, LightQuality::Still});
    videoMaker.makeFromHdr(*surround, video);
    const LightReport steady = videoMaker.makeFromHdr(*surround, video);
    const LightReport once = stillMaker.makeFromHdr(*surround, still);
    const math::ShRgb harmonics = math::shProject(*surround);

    Error diffuse, nine;
    std::vector<Error> quick(roughnesses.size()), slow(roughnesses.size()), rings(roughnesses.size());
    for (const glm::dvec3& dir : directions(200)) {
        const glm::vec3 d(dir);
        const auto truth = referenceRadiance(*surround, dir, lobes);
        diffuse.add(lookUp(video.diffuse, d), truth[0]);
        nine.add(math::shDiffuseRadiance(harmonics, dir), truth[0]);
        for (size_t i = 0; i < roughnesses.size(); ++i) {
            quick[i].add(lookUpGlossy(video, d, roughnesses[i]), truth[i + 1]);
            slow[i].add(lookUpGlossy(still, d, roughnesses[i]), truth[i + 1]);
            rings[i].add(phongRingsRadiance(video.radiance, d, roughnesses[i]), truth[i + 1]);
        }
    }

    std::printf("[ ACCURACY ] %-20s diffuse %.3f %% (nine harmonics %.3f %%); light %.2f ms, still %.0f ms\n", GetParam(),
                100 * diffuse.relative(), 100 * nine.relative(), steady.total_ms(), once.total_ms());
    for (size_t i = 0; i < roughnesses.size(); ++i)
        std::printf("[ ACCURACY ]   roughness %.2f: video %6.2f %%, still %6.2f %%, 36 Phong samples %6.2f %%\n",
                    static_cast<double>(roughnesses[i]), 100 * quick[i].relative(), 100 * slow[i].relative(),
                    100 * rings[i].relative());
    EXPECT_LT(diffuse.relative(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Surrounds, LightAccuracy,
                         testing::Values("venice_sunset", "studio_small_03", "dikhololo_night", "st_fagans_interior",
                                         "kloppenheim_05", "rainforest_trail"),
                         [](const auto& each) { return std::string(each.param); });

} // namespace
} // namespace shoal::light
