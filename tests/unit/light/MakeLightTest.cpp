#include "engine/light/MakeLight.h"
#include "engine/light/BruteForceDiffuse.h"
#include "engine/light/Lookup.h"
#include "engine/light/PackedLight.h"
#include "tests/Test.h"
#include "tests/unit/light/Environments.h"

#include <glm/gtc/packing.hpp>

#include <random>

namespace shoal::light {
namespace {

EnvironmentLight lightOf(const ImageRgbF& environment, LightQuality quality = LightQuality::Video) {
    EnvironmentLight light;
    LightMaker maker({1024, 0.1f, quality});
    maker.makeFromHdr(environment, light);
    return light;
}

// Kernels are scaled to sum to 1 in double; floats of up to 3 through two transforms of nine stages each
// round at 2e-7 a renderer.
TEST(MakeLight, WhiteFurnaceIsExact) {
    const glm::dvec3 white(0.25, 1, 3);
    for (const LightQuality quality : {LightQuality::Video, LightQuality::Still}) {
        const EnvironmentLight light = lightOf(uniform(1024, white), quality);
        EXPECT_LT(largestDifference(light.diffuse, white), 1e-5);
        ASSERT_EQ(light.glossy.size(), 19u); // mirrors at 1024 and 512, 17 filtered
        for (size_t k = 0; k < light.glossy.size(); ++k)
            EXPECT_LT(largestDifference(glossyImage(light, k), white), 1e-5) << "glossy level " << k;
        const glm::vec3 rings = phongRingsRadiance(light.radiance, glm::vec3(0.6f, 0, 0.8f), 0.4);
        EXPECT_LT(glm::length(rings - glm::vec3(white)), 1e-5f);
    }
}

// The thesis' sizes, but for 1024, which takes a minute. Sums over texels leave an error that goes with the
// square of their width (tests/unit/light_baselines), and rounding of 32768 floats 1e-5 (measured).
TEST(BruteForceDiffuse, EvenLightStaysAtEverySize) {
    PyramidMaker maker;
    RadiancePyramid pyramid;
    maker.make(uniform(256, glm::dvec3(0.25, 1, 3)), 256, pyramid);
    for (const int width : {16, 32, 64, 128, 256, 1024}) {
        ImageRgbF map;
        BruteForceDiffuse(width).make(pyramid, map);
        ASSERT_EQ(map.width, std::min(width, 256)); // no wider than the pyramid
        const double tolerance = 0.008 * std::pow(16.0 / map.width, 2) + 2e-5;
        for (size_t i = 0; i < map.pixels.size(); i += 3) {
            EXPECT_NEAR(map.pixels[i], 0.25, 0.25 * tolerance);
            EXPECT_NEAR(map.pixels[i + 2], 3, 3 * tolerance);
        }
    }
}

TEST(GlossyPlans, RunFromTheMirrorToTheMatteSurface) {
    for (const int base : {256, 512, 4096})
        for (const float minimum : {0.0f, 0.1f, 0.27f, 0.5f, 1.0f})
            for (const LightQuality quality : {LightQuality::Video, LightQuality::Still}) {
                const auto plans = glossyPlans(base, minimum, quality);
                EXPECT_EQ(plans.front().width, base);
                EXPECT_FALSE(plans.front().filtered);
                EXPECT_EQ(plans.back().roughness, 1.0f);
                float smoothest = 1;
                for (size_t k = 0; k < plans.size(); ++k) {
                    EXPECT_LE(plans[k].width, base);
                    if (plans[k].filtered) smoothest = std::min(smoothest, plans[k].roughness);
                    if (k == 0) continue;
                    EXPECT_GT(plans[k].roughness, plans[k - 1].roughness);
                    if (plans[k].filtered == plans[k - 1].filtered && plans[k].roughness < 1) {
                        EXPECT_LE(plans[k].width, plans[k - 1].width);
                    }
                    EXPECT_GE(plans[k].filtered, plans[k - 1].filtered);
                }
                EXPECT_LE(smoothest, std::max(minimum, 0.1f) * 1.0001f);         // made for all surfaces,
                EXPECT_GT(smoothest, std::max(minimum, 0.1f) / 1.2f) << minimum; // and for no others
            }
}

TEST(GlossyPlans, LodOfALevelsRoughnessIsTheLevel) {
    const EnvironmentLight light = lightOf(uniform(512, glm::dvec3(1)));
    EXPECT_TRUE(light.glossy[0].radianceLin.empty());
    for (size_t k = 0; k < light.glossy.size(); ++k)
        EXPECT_NEAR(lodFromRoughness(light.glossy, light.glossy[k].roughness), static_cast<float>(k), 1e-4f);
    EXPECT_EQ(lodFromRoughness(light.glossy, 0.0f), 0.0f);
}

// Suns of one texel in a sky of 1, of 10^5 to the most that counts as light. Irradiance / pi is the sky's
// plus the sun's by its cosine. The map's mean is that within 0.5 %; its texels within 1.5 % of the
// strongest, because 64 x 32 of them, made for linear lookup, round the kink where the sun sets. The texture
// of half floats is cut, the light is not.
TEST(MakeLight, StrongSunsKeepTheirEnergy) {
    ImageRgbF sky = uniform(1024, glm::dvec3(1));
    const glm::dvec3 sun = directionFromLatLong(glm::dvec2(500.5 / 1024, 100.5 / 512));
    for (const float radiance : {1e5f, 1e6f, 1e7f, 1e8f, 1e9f}) {
        std::fill_n(sky.at(500, 100), 3, radiance);
        const EnvironmentLight light = lightOf(sky);
        EXPECT_EQ(light.radiance.levels[0].at(500, 100)[0], radiance);
        const double strongest = 1 + radiance * texelSolidAngle(100, 1024, 512) / std::numbers::pi;
        double sum = 0, want = 0;
        for (int y = 0; y < light.diffuse.height; ++y)
            for (int x = 0; x < light.diffuse.width; ++x) {
                const glm::dvec3 normal =
                    texelDirection<double>(x, y, light.diffuse.width, light.diffuse.height);
                const double truth = 1 + (strongest - 1) * std::max(0.0, glm::dot(normal, sun));
                const auto got = static_cast<double>(light.diffuse.at(x, y)[1]);
                ASSERT_NEAR(got, truth, 0.015 * strongest) << radiance;
                const double area = texelSolidAngle(y, light.diffuse.width, light.diffuse.height);
                sum += area * got, want += area * truth;
            }
        EXPECT_NEAR(sum / want, 1, 0.005) << radiance;
        PackedLight packed;
        packLight(light, MirrorMaps::Pyramid, packed);
        for (const uint16_t half : packed.atlas.pixels) ASSERT_LT(half, 0x7c00) << "finite and not negative";
        EXPECT_EQ(packed.mirrors[0].at(500, 100)[0], 0x7bff) << "65504";
        EXPECT_EQ(packed.scale, 1);
        // Scaled nothing is cut, and the sky beside the sun is kept within the 1 % that half floats leave.
        packLight(light, MirrorMaps::Pyramid, packed, TooBright::Scale);
        EXPECT_NEAR(packed.scale, radiance / kMaxHalf, 1e-3f * packed.scale);
        EXPECT_EQ(packed.mirrors[0].at(500, 100)[0], 0x7bff);
        const float beside = packed.scale * glm::unpackHalf1x16(packed.mirrors[0].at(10, 400)[0]);
        EXPECT_NEAR(beside, 1, 0.01f) << radiance;
    }
}

TEST(PhongRings, StandForTheWholeLobe) {
    for (const double roughness : {0.05, 0.3, 0.6, 1.0}) {
        const auto rings = phongRings(roughness);
        double sum = 0, before = 0;
        for (const PhongRing& ring : rings) {
            EXPECT_GT(ring.angle, before);
            EXPECT_LT(ring.angle, std::numbers::pi / 2);
            before = ring.angle;
            sum += ring.weight;
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
        // Half the peak lies between the third ring and the fourth.
        const double exponent = 0.5 / std::pow(roughness, 4) + 0.5;
        const double half = std::acos(std::exp2(-1 / exponent));
        EXPECT_LT(rings[2].angle, half);
        EXPECT_GT(rings[3].angle, half);
    }
}

EnvironmentLight lightOf(const ImageRgbF& environment, LightMaker& maker) {
    EnvironmentLight light;
    maker.makeFromHdr(environment, light);
    return light;
}

// Returns the largest change of any texel, relative to the texel.
double largestStep(const ImageRgbF& before, const ImageRgbF& after) {
    double worst = 0;
    for (size_t i = 0; i < before.pixels.size(); ++i)
        worst = std::max(worst, static_cast<double>(std::abs(after.pixels[i] - before.pixels[i]) /
                                                    std::max(before.pixels[i], 1e-6f)));
    return worst;
}

// A sky of 1 with a square sun of two texels by two, 10^4 brighter, standing between texels as it comes.
ImageRgbF skyWithSun(double column, double row) {
    ImageRgbF sky = uniform(1024, glm::dvec3(1));
    const auto cover = [](double texel, double first) { // of 2 texels from `first` on, what lies in this one
        return std::max(0.0, std::min(texel + 1, first + 2) - std::max(texel, first));
    };
    for (int y = static_cast<int>(row); y < static_cast<int>(row) + 3; ++y)
        for (int x = static_cast<int>(column); x < static_cast<int>(column) + 3; ++x)
            for (int c = 0; c < 3; ++c)
                sky.at(x % 1024, y)[c] += static_cast<float>(1e4 * cover(x, column) * cover(y, row));
    return sky;
}

// The sun moves by a tenth of a texel a frame along a row, down a meridian, and diagonally over the seam.
TEST(Stability, ACreepingSunMovesTheLightWithoutAStep) {
    for (const LightQuality quality : {LightQuality::Video, LightQuality::Still})
        for (const auto& [column, row, along, down] : {std::array{300.0, 150.0, 0.1, 0.0},
                                                       {300.0, 250.3, 0.0, 0.1},
                                                       {1021.0, 40.0, 0.08, 0.06},
                                                       {500.0, 2.0, 0.1, 0.0}}) {
            LightMaker maker({1024, 0.5f, quality});
            EnvironmentLight before = lightOf(skyWithSun(column, row), maker);
            for (int frame = 1; frame < 25; ++frame) {
                EnvironmentLight after =
                    lightOf(skyWithSun(column + frame * along, row + frame * down), maker);
                ASSERT_LT(largestStep(before.diffuse, after.diffuse), 0.01)
                    << "frame " << frame << " from " << column << ", " << row;
                std::swap(before, after);
            }
        }
}

// Soft caps of many sizes and colours: an environment that can be painted turned by any angle.
ImageRgbF caps(const glm::dmat3& turn) {
    struct Cap {
        glm::dvec3 axis, colour;
        double cosine, softness;
    };
    std::mt19937 random(11);
    const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
    std::vector<Cap> list;
    for (int i = 0; i < 40; ++i) {
        const double y = 2 * unit() - 1, angle = 6.283 * unit(), ring = std::sqrt(1 - y * y);
        list.push_back({turn * glm::dvec3(ring * std::cos(angle), y, ring * std::sin(angle)),
                        glm::dvec3(unit(), unit(), unit()) * (i < 4 ? 200.0 : 3.0),
                        std::cos(i < 4 ? 0.06 : 0.1 + 0.5 * unit()), i < 4 ? 0.001 : 0.02});
    }
    return paint(1024, 512, [&](const glm::dvec3& d) {
        glm::dvec3 sum(0.1);
        for (const Cap& cap : list)
            sum += cap.colour * std::clamp((glm::dot(d, cap.axis) - cap.cosine) / cap.softness, 0.0, 1.0);
        return sum;
    });
}

// Yaw by no whole number of texels, pitch over the pole: the light turns along.
TEST(Stability, TurningTheEnvironmentByAnyAngleTurnsTheLight) {
    LightMaker maker({1024, 0.2f});
    const EnvironmentLight still = lightOf(caps(glm::dmat3(1)), maker);
    const glm::dmat4 one(1);
    for (const glm::dmat4& turn4 :
         {glm::rotate(one, 0.1234, glm::dvec3(0, 1, 0)), glm::rotate(one, 2.5, glm::dvec3(0, 1, 0)),
          glm::rotate(one, 1.2, glm::dvec3(1, 0, 0)), glm::rotate(one, -2.0, glm::dvec3(0.6, 0, 0.8))}) {
        const glm::dmat3 turn(turn4);
        const EnvironmentLight turned = lightOf(caps(turn), maker);
        double diffuse = 0, diffuseAll = 0, glossy = 0, glossyAll = 0;
        for (int i = 0; i < 2000; ++i) {
            const double y = 1 - (2 * i + 1.0) / 2000, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
            const double ring = std::sqrt(1 - y * y);
            const glm::dvec3 d(ring * std::cos(angle), y, ring * std::sin(angle));
            const glm::vec3 a = lookUp(still.diffuse, d), b = lookUp(turned.diffuse, turn * d);
            EXPECT_LT(glm::length(a - b), 0.005f * glm::length(a)) << "diffuse at " << d.x << " " << d.y;
            diffuse += glm::dot(a - b, a - b), diffuseAll += glm::dot(a, a);
            const glm::vec3 c = lookUpGlossy(still, d, 0.3f), e = lookUpGlossy(turned, turn * d, 0.3f);
            glossy += glm::dot(c - e, c - e), glossyAll += glm::dot(c, c);
        }
        EXPECT_LT(std::sqrt(diffuse / diffuseAll), 0.001);
        EXPECT_LT(std::sqrt(glossy / glossyAll), 0.01);
    }
}

} // namespace
} // namespace shoal::light
