// Diffuse and glossy light of made and of real environments against the double-precision integrals over every
// texel.
#include "tests/Test.h"
#include "tests/accuracy/light/RadianceFile.h"
#include "tests/unit/light/Environments.h"

#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "engine/math/SphericalHarmonics.h"
#include "tests/baselines/light/Reference.h"

namespace shoal::light {
namespace {

Path hdrFolder() { return tests::sharedDataFolder() / "hdr"; }

struct Sample {
    glm::dvec3 direction{0};
    double solidAngle = 0;
};

// Spread evenly over the ring between two angles from the axis (Fibonacci lattice).
void spread(const glm::dvec3& axis, double from, double to, int count, std::vector<Sample>& out) {
    const glm::dvec3 side =
        glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 up = glm::cross(side, axis);
    for (int i = 0; i < count; ++i) {
        const double z = std::lerp(std::cos(from), std::cos(to), (i + 0.5) / count);
        const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0)), ring = std::sqrt(1 - z * z);
        out.push_back({axis * z + ring * (std::cos(turn) * side + std::sin(turn) * up),
                       2 * std::numbers::pi * (std::cos(from) - std::cos(to)) / count});
    }
}

// Returns directions over the sphere, denser around its brightest texel, which dominates narrow lobes.
std::vector<Sample> samplesFor(const ImageRgbF& environment) {
    glm::dvec3 axis(0);
    double maximum = -1;
    math::eachTexel(environment, [&](const glm::dvec3& radiance, double, const glm::dvec3& direction) {
        if (radiance.g > maximum) maximum = radiance.g, axis = direction;
    });
    std::vector<Sample> samples;
    spread(axis, 0, 0.05, 12, samples);
    spread(axis, 0.05, 0.3, 12, samples);
    spread(axis, 0.3, std::numbers::pi, 30, samples);
    return samples;
}

struct Error {
    double squares = 0, truth = 0, worst = 0;
    void add(const glm::dvec3& got, const glm::dvec3& want, double solidAngle) {
        squares += solidAngle * glm::dot(got - want, got - want);
        truth += solidAngle * glm::dot(want, want);
        worst = std::max(worst, glm::length(got - want) / glm::length(want));
    }
    double relative() const { return std::sqrt(squares / truth); }
};

constexpr int kWidth = 1024, kHeight = 512;

// Returns a sky of 1 with a square of four texels 10^4 brighter, whose top left texel is given.
ImageRgbF sun(int column, int row) {
    ImageRgbF image = uniform(kWidth, glm::dvec3(1));
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) image.at((column + i % 2) % kWidth, row + i / 2)[c] = 1e4f;
    return image;
}

ImageRgbF checkerboard() {
    ImageRgbF image(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = (x + y) % 2 ? 2.0f : 0.0f;
    return image;
}

std::optional<ImageRgbF> environmentNamed(const std::string& name) {
    if (name == "uniform") return uniform(kWidth, glm::dvec3(1));
    if (name == "half")
        return paint(kWidth, kHeight, [](const glm::dvec3& d) {
            return glm::dvec3(0.6 * d.x + 0.64 * d.y + 0.48 * d.z > 0 ? 1.0 : 0.0);
        });
    if (name == "gradient")
        return paint(kWidth, kHeight, [](const glm::dvec3& d) {
            return glm::dvec3(1 + d.y, 1.5 + d.x, 2 + 0.5 * (d.z + d.y));
        });
    if (name == "checkerboard") return checkerboard();
    if (name == "sun_zenith") return sun(300, 0);
    if (name == "sun_beside_pole") return sun(300, 5);
    if (name == "sun_horizon") return sun(300, 255);
    if (name == "sun_seam") return sun(1023, 200);
    return readRadianceFile(hdrFolder() / (name + "_1k.hdr"));
}

constexpr float kRoughness[] = {0.1f, 0.11f, 0.15f, 0.2f, 0.25f, 0.3f, 0.4f,
                                0.5f, 0.6f,  0.7f,  0.8f, 0.9f,  1.0f};

class LightAccuracy : public testing::TestWithParam<const char*> {};

// Errors include those of look-ups. The light promises these bounds; the suns test only some directions.
TEST_P(LightAccuracy, AgainstTheIntegral) {
    const std::string name = GetParam();
    const auto environment = environmentNamed(name);
    if (!environment) GTEST_SKIP() << "needs the reference data in " << hdrFolder();
    std::vector<Lobe> lobes = {diffuseLobe()};
    for (const float roughness : kRoughness) lobes.push_back(glossyLobe(roughness));

    EnvironmentLight light;
    static LightMaker maker({1024, 0.1f, LightQuality::Still}); // its tables take half of a case's time
    maker.makeFromHdr(*environment, light);

    Error diffuse;
    std::vector<Error> glossy(std::size(kRoughness));
    for (const auto& [dir, solidAngle] : samplesFor(*environment)) {
        const glm::vec3 d(dir);
        const auto truth = referenceRadiance(*environment, dir, lobes);
        diffuse.add(lookUp(light.diffuse, d), truth[0], solidAngle);
        for (size_t i = 0; i < std::size(kRoughness); ++i)
            glossy[i].add(lookUpGlossy(light, d, kRoughness[i]), truth[i + 1], solidAngle);
    }

    EXPECT_LT(diffuse.relative(), 0.005);
    EXPECT_LT(diffuse.worst, 0.02);
    for (size_t i = 0; i < std::size(kRoughness); ++i)
        EXPECT_LT(glossy[i].relative(), name.starts_with("sun") ? 0.10 : 0.02)
            << "roughness " << kRoughness[i];
}

INSTANTIATE_TEST_SUITE_P(Environments, LightAccuracy,
                         testing::Values("uniform", "half", "gradient", "checkerboard", "sun_zenith",
                                         "sun_beside_pole", "sun_horizon", "sun_seam", "venice_sunset",
                                         "studio_small_03", "dikhololo_night", "st_fagans_interior",
                                         "kloppenheim_05", "rainforest_trail"),
                         [](const auto& each) { return std::string(each.param); });

} // namespace
} // namespace shoal::light
