// The light follows the environment: it does not jump as a sun moves slowly, and turns with the environment.
#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "tests/unit/light/Environments.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <random>

namespace shoal::light {
namespace {

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

TEST(Stability, EqualFramesGiveEqualLight) {
    LightMaker maker;
    const ImageRgbF environment = noise(512, 256);
    const EnvironmentLight first = lightOf(environment, maker), second = lightOf(environment, maker);
    EXPECT_EQ(first.diffuse.pixels, second.diffuse.pixels);
    for (size_t k = 0; k < first.glossy.size(); ++k)
        EXPECT_EQ(first.glossy[k].radianceLin.pixels, second.glossy[k].radianceLin.pixels);
}

// Sensor noise of a dim video: each coded value off by up to one, anew in each frame. Over the 10^5 texels
// that light a surface that is nothing: 1 of 128 at 1.8 and a twelfth of its square, over the square root.
TEST(Stability, NoiseOfAStillVideoIsNotSeen) {
    LightMaker maker({512, 0.2f});
    EnvironmentLight before, after;
    std::mt19937 random(5);
    for (int frame = 0; frame < 6; ++frame) {
        std::vector<uint8_t> pixels(2048 * 1024 * 3);
        for (uint8_t& value : pixels) value = static_cast<uint8_t>(127 + random() % 3);
        maker.make({pixels.data(), 2048, 1024, 2048 * 3, true}, after);
        if (frame) {
            EXPECT_LT(largestStep(before.diffuse, after.diffuse), 1e-4);
        }
        std::swap(before, after);
    }
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
