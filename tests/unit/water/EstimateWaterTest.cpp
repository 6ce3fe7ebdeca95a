// Tests that known water is found again in frames made with it.
#include "engine/water/EstimateWater.h"
#include "MadeFrames.h"
#include "engine/core/Files.h"
#include "engine/media/Pictures.h"
#include "tests/TestPaths.h"
#include "tests/unit/water/SeenThrough.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace shoal::water {

void PrintTo(const Sea& sea, std::ostream* out) {
    *out << "beta " << sea.attenuation_perM.x << " " << sea.attenuation_perM.y << " "
         << sea.attenuation_perM.z << ", walls " << sea.wallShare << ", texture " << sea.texture;
}

namespace {

WaterEstimate estimated(const ImageRgb8& frame) { return WaterEstimator().estimate(viewOf(frame)); }

glm::vec3 coded(const glm::vec3& lin) {
    return {math::srgbFromLinear(lin.x), math::srgbFromLinear(lin.y), math::srgbFromLinear(lin.z)};
}

class KnownSea : public testing::TestWithParam<Sea> {};

// The sea shows its veil where it is endless: around the horizon, and above as far as the surface mirrors.
TEST_P(KnownSea, TheVeilIsFoundAgain) {
    const Sea& sea = GetParam();
    const Water water = estimated(filmed(sea)).water;
    for (const float elevation_deg : {0.0f, 15.0f, 30.0f})
        for (const float yaw_deg : {0.0f, 90.0f, 150.0f}) { // walls stand to the left
            const float e = glm::radians(elevation_deg), a = glm::radians(yaw_deg);
            const glm::vec3 dir(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a));
            const glm::vec3 lin = rayThrough(sea, dir.y, kFar_m).glowLin;
            const glm::vec3 truth = coded(lin);
            const glm::vec3 found = glm::sqrt(veilTowards(water, dir));
            // 14 of 255: the quadratic in direction is no better fit to a wall's edge than that.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], truth[c], 0.055f) << elevation_deg << " " << yaw_deg;
        }
}

TEST_P(KnownSea, IsKnownAsWater) { EXPECT_EQ(estimated(filmed(GetParam())).evidence, 1); }

const auto kClearCoasts =
    testing::Values(Sea{}, Sea{.texture = 0.4f}, Sea{.wallShare = 0.3f, .texture = 0.4f},
                    Sea{.eyeHeight_m = 2.5f},               // deeper below
                    Sea{.sandLin = {0.10f, 0.20f, 0.22f}}); // a dim day
const auto kOthers =                                        // a clear ocean, and a green coast
    testing::Values(Sea{.attenuation_perM = {0.14f, 0.06f, 0.045f}, .veilLin = {0.02f, 0.12f, 0.25f}},
                    Sea{.attenuation_perM = {0.40f, 0.22f, 0.26f}, .veilLin = {0.03f, 0.14f, 0.10f}});
INSTANTIATE_TEST_SUITE_P(ClearCoasts, KnownSea, kClearCoasts);
INSTANTIATE_TEST_SUITE_P(Others, KnownSea, kOthers);

// Seas whose water satisfies the assumptions of attenuationFromVeil().
class ClearCoast : public KnownSea {};

// The estimate's purpose: an object drawn at a distance looks like one of the same colour filmed there.
TEST_P(ClearCoast, AThingDrawnLooksAsAThingFilmed) {
    const Sea& sea = GetParam();
    const Water water = estimated(filmed(sea)).water;
    for (const glm::vec3& sent : {sea.rockLin, sea.sandLin, glm::vec3(0.01f), glm::vec3(0.2f, 0.1f, 0.05f)})
        for (const float distance_m : {0.5f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f})
            for (const glm::vec3 dir : {glm::vec3(1, 0, 0), glm::vec3(0.96f, 0.28f, 0)}) {
                const glm::vec3 filmedThere = coded(rayThrough(sea, dir.y, distance_m).from(sent));
                const glm::vec3 drawn = seenThrough(water, coded(sent), dir, distance_m);
                // 12 of 255: a fifth of beta at 4 m, and squares instead of sRGB's curve.
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(255 * drawn[c], 255 * filmedThere[c], 12)
                        << distance_m << " m, channel " << c << ", sent " << sent[c];
            }
}

INSTANTIATE_TEST_SUITE_P(Seas, ClearCoast, kClearCoasts);

TEST(EstimateWater, AnEvenFrameIsAllVeil) {
    const auto estimate = estimated(evenFrame(40, 110, 150));
    const glm::vec3 prior = estimate.water.attenuation_perM;
    EXPECT_GT(prior.x, prior.y);
    EXPECT_GT(prior.y, prior.z); // bluer water takes less blue
    for (const auto& dir : {glm::vec3(0, 0, -1), glm::vec3(0, 1, 0), glm::vec3(0.6f, -0.8f, 0)})
        for (int c = 0; c < 3; ++c) { // and all of its veil, but for the stiffness of bands 1 and 2: exact
            const glm::vec3 shown = glm::vec3(40, 110, 150) / 255.0f;
            EXPECT_NEAR(std::sqrt(veilTowards(estimate.water, dir)[c]), shown[c], 0.005f);
        }
}

TEST(EstimateWater, StaysWithinTheSeasBoundsWhateverComes) {
    Random random(7, 1);
    ImageRgb8 noise(256, 128);
    for (uint8_t& value : noise.pixels) value = static_cast<uint8_t>(random.between(0, 255.9f));
    for (const ImageRgb8& frame : {evenFrame(0, 0, 0), evenFrame(255, 255, 255), evenFrame(255, 0, 0), noise})
        for (int c = 0; c < 3; ++c) {
            const Water water = estimated(frame).water;
            EXPECT_GE(water.attenuation_perM[c], 0.015f); // clearest ocean, in blue
            EXPECT_LE(water.attenuation_perM[c], 1.5f);   // turbid coast, in red
            for (const glm::vec3& term : water.veil) EXPECT_TRUE(std::isfinite(term[c]));
        }
}

TEST(EstimateWater, TheSameFrameGivesTheSameWater) {
    const ImageRgb8 frame = filmed({.texture = 0.4f});
    WaterEstimator estimator;
    const WaterEstimate first = estimator.estimate(viewOf(frame));
    estimator.estimate(viewOf(evenFrame(9, 90, 120)));
    const WaterEstimate second = estimator.estimate(viewOf(frame));
    EXPECT_EQ(first.water.attenuation_perM, second.water.attenuation_perM);
    EXPECT_EQ(first.water.veil, second.water.veil);
}

TEST(EstimateWater, ReadsBlueFirstFramesAndPartsOfFrames) {
    const ImageRgb8 frame = filmed({});
    ImageRgb8 other(frame.width + 10, frame.height + 4); // with a margin of another colour
    std::fill(other.pixels.begin(), other.pixels.end(), uint8_t{200});
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            for (int c = 0; c < 3; ++c) other.at(x + 5, y + 2)[c] = frame.at(x, y)[2 - c];
    const light::FrameView part{other.at(5, 2), frame.width, frame.height, 3 * other.width, true};
    EXPECT_EQ(WaterEstimator().estimate(part).water.attenuation_perM,
              WaterEstimator().estimate(viewOf(frame)).water.attenuation_perM);
}

// Photographs of dry land and of a cave under water.
TEST(EstimateWater, TellsLandFromWater) {
    const Path photos = tests::sharedDataFolder() / "photo";
    if (!std::filesystem::exists(photos)) GTEST_SKIP() << photos << " is missing";
    const auto evidence = [&](const char* name, bool upperHalf) {
        const auto picture = media::readPicture(photos / name);
        if (!picture) return -1.0f;
        return WaterEstimator()
            .estimate({picture->pixels.data(), picture->width, picture->height / (upperHalf ? 2 : 1),
                       3 * picture->width, false})
            .evidence;
    };
    EXPECT_EQ(evidence("petra_360_2048x1024.jpg", false), 0);
    EXPECT_EQ(evidence("puydesancy_360_4096x2048.jpg", false), 0);
    EXPECT_EQ(evidence("coral_underwater_360_overunder_2048.jpg", true), 1);
}

} // namespace
} // namespace shoal::water
