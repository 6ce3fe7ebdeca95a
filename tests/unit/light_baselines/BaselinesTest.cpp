// Glossy methods keep uniform light, are right in smooth light, and agree whether they filter maps or gather.
#include "tests/baselines/light/Baselines.h"
#include "engine/light/InverseToneMap.h"
#include "engine/light/Lookup.h"
#include "engine/light/Pyramid.h"
#include "engine/math/Colour.h"
#include "tests/Test.h"
#include "tests/baselines/light/Harmonics.h"
#include "tests/baselines/light/Reference.h"
#include "tests/baselines/light/Taps.h"
#include "tests/unit/light/Environments.h"

namespace shoal::light::baselines {
namespace {

// Returns the ends of the axes, and directions at these heights and turns.
std::vector<glm::vec3> directionsAt(std::initializer_list<float> heights,
                                    std::initializer_list<float> turns) {
    std::vector<glm::vec3> all = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}};
    for (const float y : heights)
        for (const float turn : turns)
            all.emplace_back(std::sqrt(1 - y * y) * std::sin(turn), y, std::sqrt(1 - y * y) * std::cos(turn));
    return all;
}

const std::vector<glm::vec3> kDirs = directionsAt({-0.9f, -0.2f, 0.5f}, {0.3f, 1.9f, 3.1f});

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
        const double off =
            got[i].x - referenceRadiance(sky, glm::normalize(glm::dvec3(kDirs[i])), lobes)[0].x;
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

const std::vector<glm::vec3> kNormals = directionsAt({-0.8f, -0.3f, 0.4f, 0.9f}, {0.3f, 1.9f, 3.1f, 5.0f});

// Largest difference of the red light from what is wanted of each normal.
double farthest(DiffuseMethod method, const ImageRgbF& environment,
                const std::function<double(const glm::dvec3&)>& want) {
    const RadiancePyramid pyramid = pyramidOf(environment);
    method.update(Input{&pyramid, {}, &environment});
    std::vector<glm::vec3> got(kNormals.size());
    method.shade(kNormals, got);
    double worst = 0;
    for (size_t i = 0; i < got.size(); ++i)
        worst = std::max(worst, std::abs(got[i].x - want(glm::dvec3(kNormals[i]))));
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
                const auto value = static_cast<double>(values[i]);
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

TEST(PyramidBaselines, UniformFrameStaysInEveryLevel) {
    const glm::vec3 want = radianceFromDisplay(glm::vec3(200, 120, 40) / 255.0f);
    for (const auto& [width, height, bgr] :
         {std::tuple(2048, 1024, false), {2048, 1024, true}, {600, 300, true}}) {
        const ImageRgb8 frame =
            bgr ? evenFrame(width, height, 40, 120, 200) : evenFrame(width, height, 200, 120, 40);
        for (const PyramidMethod& method : pyramidMethods()) {
            RadiancePyramid pyramid;
            method.make(viewOf(frame, bgr), pyramid);
            ASSERT_EQ(pyramid.levels.back().width, 2) << method.label.name;
            for (const ImageRgbF& level : pyramid.levels)
                for (size_t i = 0; i < level.pixels.size(); ++i)
                    ASSERT_NEAR(level.pixels[i], want[static_cast<int>(i % 3)], 1e-5f) << method.label.name;
        }
    }
}

// A cap of 30 degrees about the zenith, a sixth of the rows, is (1 - cos 30) / 2 = 6.7 % of the sphere; plain
// means take it for 16.7 %. Where the frame is resampled, the
// edge moves by up to a row of 512.
TEST(PyramidBaselines, PlainMeansGiveTheZenithTooMuch) {
    ImageRgb8 frame = evenFrame(2048, 1020, 0, 0, 0);
    for (int y = 0; y < 170; ++y) std::fill(frame.at(0, y), frame.at(0, y) + 3 * 2048, uint8_t{255});
    for (const PyramidMethod& method : pyramidMethods()) {
        RadiancePyramid pyramid;
        method.make(viewOf(frame), pyramid);
        const bool plain = method.label.name.starts_with("plain");
        EXPECT_NEAR(pyramid.levels.back().pixels[0] / 11.8f, plain ? 0.1667f : 0.0670f, 2e-3f)
            << method.label.name;
    }
}

// Returns what becomes of a value in a picture of 30 such pixels, a black and a white one.
float expanded(const InverseToneMapMethod& method, uint8_t value) {
    ImageRgb8 frame = evenFrame(8, 4, value, value, value);
    std::fill_n(frame.at(0, 0), 3, uint8_t{0});
    std::fill_n(frame.at(1, 0), 3, uint8_t{255});
    ImageRgbF out;
    method.expand(frame, out);
    return out.pixels.back();
}

TEST(InverseToneMapBaselines, KnownValues) {
    const float middle = 188.0f / 255; // sRGB 0.5029
    EXPECT_NEAR(expanded(thesisInverse(false), 188), radianceFromDisplay(glm::vec3(middle)).x, 1e-6f);
    EXPECT_NEAR(expanded(plainLinear(), 188), 0.5029f, 1e-4f);
    EXPECT_NEAR(expanded(thesisInverse(true), 188), (10 * std::pow(0.5029f, 10.0f) + 1.8f) * 0.5029f, 1e-3f);
    EXPECT_NEAR(expanded(akyuz(1), 188), 0.5029f, 1e-4f);
    EXPECT_NEAR(expanded(akyuz(2.2f), 188), std::pow(0.5029f, 2.2f), 1e-3f);
    EXPECT_NEAR(expanded(landis(), 128), 0.2159f, 1e-4f); // below the threshold: as decoded
    EXPECT_NEAR(expanded(landis(), 255), 10.0f, 1e-4f);
}

TEST(InverseToneMapBaselines, MasiasPowers) {
    const float l = 0.5029f, least = std::log(1e-6f);
    const float logMean = (30 * std::log(l) + least) / 32, key = (logMean - least) / -least;
    EXPECT_NEAR(expanded(masia2009(), 188), std::pow(l, 10.44f * key - 6.282f), 1e-3f);
    EXPECT_NEAR(expanded(masia2017(), 188),
                std::pow(l, 2.4379f + 0.2319f * logMean - 1.1228f * key + 0.0085f * 100 / 32), 1e-3f);
}

// A white disc in grey: white there becomes 10, the formula's (10 * 10 / 2) * (2 / 10), and far from it a
// grey stays. Half as much light as white, expanded wholly, would be 50 (-0.5 + sqrt(0.25 + 0.02)) = 0.98.
TEST(InverseToneMapBaselines, ExpandsWhereThereIsMuchLight) {
    ImageRgb8 frame = evenFrame(256, 128, 20, 20, 20);
    for (int y = 52; y < 76; ++y) std::fill_n(frame.at(116, y), 3 * 24, uint8_t{255});
    ImageRgbF out;
    banterle().expand(frame, out);
    EXPECT_NEAR(out.at(128, 64)[0], 10, 1);
    EXPECT_NEAR(out.at(0, 64)[0], math::linearFromSrgb(20 / 255.0f), 1e-3f);
}

TEST(InverseToneMapBaselines, BrightensAroundWhatIsClipped) {
    ImageRgb8 frame = evenFrame(256, 128, 128, 128, 128);
    for (int y = 60; y < 68; ++y) std::fill_n(frame.at(120, y), 3 * 16, uint8_t{255});
    ImageRgbF out;
    for (const InverseToneMapMethod& method : {rempel(), kovaleski()}) {
        method.expand(frame, out);
        EXPECT_GT(out.at(128, 64)[0], 2) << method.label.name;
        EXPECT_NEAR(out.at(0, 64)[0], 0.2159f, 1e-3f) << method.label.name;
    }
    EXPECT_NEAR(out.at(116, 64)[0], 0.2159f, 1e-3f); // unlike what is clipped beside it
}

} // namespace
} // namespace shoal::light::baselines
