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

// Roughnesses looked up, with the largest relative error allowed of the light for videos and of that for
// stills. Measured over the six surrounds and rounded up by a fifth. At 0.5 and 0.8 two levels are mixed, at
// the others one level stands alone.
struct Row {
    float roughness;
    double video, still;
};
constexpr Row kRows[] = {{0.10f, 0.055, 0.055}, {0.20f, 0.025, 0.020}, {0.35f, 0.020, 0.020},
                         {0.50f, 0.155, 0.155}, {0.60f, 0.040, 0.012}, {0.80f, 0.080, 0.080},
                         {1.00f, 0.030, 0.030}};
constexpr double kDiffuse = 0.01; // nobody sees a hundredth; measured 0.005

// Relative root mean square errors over 200 directions, bilinear and trilinear lookups included.
class LightAccuracy : public testing::TestWithParam<const char*> {};

TEST_P(LightAccuracy, AgainstTheIntegral) {
    const auto surround = readRadianceFile(hdrFolder() / (std::string(GetParam()) + "_1k.hdr"));
    if (!surround) GTEST_SKIP() << "needs the reference data in " << hdrFolder();
    std::vector<Lobe> lobes = {diffuseLobe()};
    for (const Row& row : kRows) lobes.push_back(glossyLobe(static_cast<double>(row.roughness)));

    EnvironmentLight video, still;
    LightMaker videoMaker({1024, LightQuality::Video}), stillMaker({1024, LightQuality::Still});
    videoMaker.makeFromHdr(*surround, video);
    const LightReport steady = videoMaker.makeFromHdr(*surround, video);
    stillMaker.makeFromHdr(*surround, still);
    const math::ShRgb harmonics = math::shProject(*surround);

    Error diffuse, nine;
    std::vector<Error> quick(std::size(kRows)), slow(std::size(kRows)), rings(std::size(kRows));
    for (const glm::dvec3& dir : directions(200)) {
        const glm::vec3 d(dir);
        const auto truth = referenceRadiance(*surround, dir, lobes);
        diffuse.add(lookUp(video.diffuse, d), truth[0]);
        nine.add(math::shDiffuseRadiance(harmonics, dir), truth[0]);
        for (size_t i = 0; i < std::size(kRows); ++i) {
            quick[i].add(lookUpGlossy(video, d, kRows[i].roughness), truth[i + 1]);
            slow[i].add(lookUpGlossy(still, d, kRows[i].roughness), truth[i + 1]);
            rings[i].add(phongRingsRadiance(video.radiance, d, kRows[i].roughness), truth[i + 1]);
        }
    }

    std::printf("[ ACCURACY ] %-20s diffuse %.3f %% (nine harmonics %.3f %%); light %.2f ms\n", GetParam(),
                100 * diffuse.relative(), 100 * nine.relative(), steady.total_ms());
    EXPECT_LT(diffuse.relative(), kDiffuse);
    for (size_t i = 0; i < std::size(kRows); ++i) {
        const auto roughness = static_cast<double>(kRows[i].roughness);
        std::printf(
            "[ ACCURACY ]   roughness %.2f: video %6.2f %%, still %6.2f %%, 36 Phong samples %6.2f %%\n",
            roughness, 100 * quick[i].relative(), 100 * slow[i].relative(), 100 * rings[i].relative());
        EXPECT_LT(quick[i].relative(), kRows[i].video) << "roughness " << roughness;
        EXPECT_LT(slow[i].relative(), kRows[i].still) << "roughness " << roughness;
    }
}

INSTANTIATE_TEST_SUITE_P(Surrounds, LightAccuracy,
                         testing::Values("venice_sunset", "studio_small_03", "dikhololo_night",
                                         "st_fagans_interior", "kloppenheim_05", "rainforest_trail"),
                         [](const auto& each) { return std::string(each.param); });

} // namespace
} // namespace shoal::light
