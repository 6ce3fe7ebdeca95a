// Tests that known water is found again in frames made with it.
#include "engine/core/Files.h"
#include "engine/core/Random.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/media/Pictures.h"
#include "engine/water/EstimateWater.h"
#include "tests/Test.h"
#include "tests/unit/water/SeenThrough.h"

namespace shoal::water {
namespace {

// Frames of a sea whose water is known: a sandy floor below, a surface above, walls of rock where asked for.
struct Sea {
    glm::vec3 attenuation_perM{0.20f, 0.10f, 0.08f};
    glm::vec3 veilLin{0.02f, 0.10f, 0.20f}; // at the horizon
    glm::vec3 sandLin{0.45f, 0.50f, 0.45f}; // albedo of the floor
    glm::vec3 rockLin{0.05f, 0.07f, 0.07f};
    float eyeHeight_m = 1.2f;
    float downwelling = 0.4f; // K / beta
    float wallShare = 0;      // share of the horizon with a wall `wall_m` away, up to 30 degrees
    float wall_m = 4;
    float texture = 0; // relative variation of sand and rock

    friend void PrintTo(const Sea& sea, std::ostream* out) {
        *out << "beta " << sea.attenuation_perM.x << " " << sea.attenuation_perM.y << " "
             << sea.attenuation_perM.z << ", walls " << sea.wallShare << ", texture " << sea.texture;
    }
};

// A ray through water: the light scattered into it, and the transmitted share of the light from its end.
struct Ray {
    glm::vec3 glowLin, left;
    glm::vec3 from(const glm::vec3& endLin) const { return glowLin + left * endLin; }
};

// The integral of single scattering along a ray. sine: sine of the ray's elevation.
Ray rayThrough(const Sea& sea, float sine, float distance_m) {
    const glm::vec3 beta = sea.attenuation_perM, fading = beta * (1 - sea.downwelling * sine);
    return {sea.veilLin * beta * (1.0f - glm::exp(-fading * distance_m)) / fading,
            glm::exp(-beta * distance_m)};
}

constexpr float kFar_m = 1e4f;

ImageRgb8 filmed(const Sea& sea, uint64_t seed = 1) {
    constexpr int kWidth = 512, kHeight = kWidth / 2;
    const glm::vec3 skyLin(0.7f, 0.85f, 1.0f); // seen through the surface
    ImageRgb8 frame(kWidth, kHeight);
    Random random(seed, 1);
    for (int y = 0; y < kHeight; ++y) {
        const float elevation = (0.5f - (static_cast<float>(y) + 0.5f) / kHeight) * 3.14159265f;
        const float sine = std::sin(elevation);
        const float open_m = sine < 0 ? sea.eyeHeight_m / -sine : kFar_m;
        const float wall_m = sea.wall_m / std::cos(elevation);
        const bool wallHere = sine < 0.5f && wall_m < open_m;
        const Ray open = rayThrough(sea, sine, open_m), toWall = rayThrough(sea, sine, wall_m);
        for (int x = 0; x < kWidth; ++x) {
            const float texture = 1 + sea.texture * random.between(-1, 1);
            const bool wall = wallHere && static_cast<float>(x) < sea.wallShare * kWidth;
            const glm::vec3 lin = elevation > 0.72f ? skyLin
                                  : wall            ? toWall.from(sea.rockLin * texture)
                                                    : open.from(sea.sandLin * texture);
            for (int c = 0; c < 3; ++c)
                frame.at(x, y)[c] = static_cast<uint8_t>(
                    std::lround(255 * glm::clamp(math::srgbFromLinear(lin[c]), 0.0f, 1.0f)));
        }
    }
    return frame;
}

WaterEstimate estimated(const ImageRgb8& frame) { return estimateWater(viewOf(frame)); }

glm::vec3 coded(const glm::vec3& lin) {
    return {math::srgbFromLinear(lin.x), math::srgbFromLinear(lin.y), math::srgbFromLinear(lin.z)};
}

const Sea kClearCoasts[] = {Sea{}, Sea{.texture = 0.4f}, Sea{.wallShare = 0.3f, .texture = 0.4f},
                            Sea{.eyeHeight_m = 2.5f},               // deeper below
                            Sea{.sandLin = {0.10f, 0.20f, 0.22f}}}; // a dim day
const Sea kOthers[] = {
    Sea{.attenuation_perM = {0.14f, 0.06f, 0.045f}, .veilLin = {0.02f, 0.12f, 0.25f}}, // a clear ocean
    Sea{.attenuation_perM = {0.40f, 0.22f, 0.26f}, .veilLin = {0.03f, 0.14f, 0.10f}}}; // a green coast

// Finds a sea's water again, and its veil around the horizon and above, as far as the surface mirrors.
Water foundAgain(const Sea& sea) {
    const WaterEstimate found = estimated(filmed(sea));
    EXPECT_EQ(found.evidence, 1);
    for (const float elevation_deg : {0.0f, 15.0f, 30.0f})
        for (const float yaw_deg : {0.0f, 90.0f, 150.0f}) { // walls stand to the left
            const float e = glm::radians(elevation_deg), a = glm::radians(yaw_deg);
            const glm::vec3 dir(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a));
            const glm::vec3 truth = coded(rayThrough(sea, dir.y, kFar_m).glowLin);
            const glm::vec3 veil = glm::sqrt(veilTowards(found.water, dir));
            // 14 of 255: the quadratic in direction is no better fit to a wall's edge than that.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(veil[c], truth[c], 0.055f) << elevation_deg << " " << yaw_deg;
        }
    return found.water;
}

TEST(EstimateWater, OtherSeasAreFoundAgain) {
    for (const Sea& sea : kOthers) {
        SCOPED_TRACE(testing::PrintToString(sea));
        foundAgain(sea);
    }
}

// The water satisfies the assumptions of attenuationFromVeil(). The estimate's purpose: an object drawn at a
// distance looks like one of the same colour filmed there.
TEST(EstimateWater, OffClearCoastsAThingDrawnLooksAsAThingFilmed) {
    for (const Sea& sea : kClearCoasts) {
        SCOPED_TRACE(testing::PrintToString(sea));
        const Water water = foundAgain(sea);
        for (const glm::vec3& sent :
             {sea.rockLin, sea.sandLin, glm::vec3(0.01f), glm::vec3(0.2f, 0.1f, 0.05f)})
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
}

TEST(EstimateWater, AnEvenFrameIsAllVeil) {
    const auto estimate = estimated(evenFrame(256, 128, 40, 110, 150));
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
    for (const ImageRgb8& frame : {evenFrame(256, 128, 0, 0, 0), evenFrame(256, 128, 255, 255, 255),
                                   evenFrame(256, 128, 255, 0, 0), noise})
        for (int c = 0; c < 3; ++c) {
            const Water water = estimated(frame).water;
            EXPECT_GE(water.attenuation_perM[c], 0.015f); // clearest ocean, in blue
            EXPECT_LE(water.attenuation_perM[c], 1.5f);   // turbid coast, in red
            for (const glm::vec3& term : water.veil) EXPECT_TRUE(std::isfinite(term[c]));
        }
}

TEST(EstimateWater, ReadsBlueFirstFramesAndPartsOfFrames) {
    const ImageRgb8 frame = filmed({});
    ImageRgb8 other = evenFrame(frame.width + 10, frame.height + 4, 200, 200, 200); // has a margin
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            for (int c = 0; c < 3; ++c) other.at(x + 5, y + 2)[c] = frame.at(x, y)[2 - c];
    const light::FrameView part{other.at(5, 2), frame.width, frame.height, 3 * other.width, true};
    EXPECT_EQ(estimateWater(part).water.attenuation_perM,
              estimateWater(viewOf(frame)).water.attenuation_perM);
}

// Leaves keep less blue than red; water keeps more, of whatever colour it is.
TEST(EstimateWater, AMeadowAndTreesAroundItAreNoWater) {
    EXPECT_EQ(estimated(evenFrame(256, 128, 70, 130, 40)).evidence, 0);
    EXPECT_EQ(estimated(evenFrame(256, 128, 70, 130, 90)).evidence, 1) << "a green coast";
}

// Photographs of dry land and of a cave under water.
TEST(EstimateWater, TellsLandFromWater) {
    const Path photos = tests::sharedDataFolder() / "photo";
    if (!std::filesystem::exists(photos)) GTEST_SKIP() << photos << " is missing";
    const auto evidence = [&](const char* name, bool upperHalf) {
        const auto photo = media::readPhoto(photos / name);
        if (!photo) return -1.0f;
        const ImageRgb8& picture = photo->picture;
        return estimateWater({picture.pixels.data(), picture.width, picture.height / (upperHalf ? 2 : 1),
                              3 * picture.width, false})
            .evidence;
    };
    EXPECT_EQ(evidence("petra_360_2048x1024.jpg", false), 0);
    EXPECT_EQ(evidence("puydesancy_360_4096x2048.jpg", false), 0);
    EXPECT_EQ(evidence("coral_underwater_360_overunder_2048.jpg", true), 1);
}

WaterEstimate estimateOf(const glm::vec3& veil, float attenuation_perM) {
    return {{.veil = {veil}, .attenuation_perM = glm::vec3(attenuation_perM)}, 1};
}

TEST(WaterOverTime, IsThereAtOnceAndStaysAsItIs) {
    const WaterEstimate estimate = estimateOf({0.1f, 0.2f, 0.3f}, 0.12f);
    WaterOverTime water;
    for (int i = 0; i < 1000; ++i) {
        water.follow(estimate, 1, 1 / 60.0f);
        ASSERT_EQ(water.water().veil[0], estimate.water.veil[0]);
        ASSERT_NEAR(water.water().attenuation_perM.y, 0.12f, 1e-6f);
    }
}

TEST(WaterOverTime, ACutIsFollowedWithinASecondWithoutAStep) {
    WaterOverTime water;
    water.follow(estimateOf(glm::vec3(0.1f), 0.1f), 1, 0);
    const WaterEstimate after = estimateOf(glm::vec3(1.1f), 0.4f);
    float before = 0.1f;
    for (int i = 0; i < 60; ++i) {
        water.follow(after, 1, 1 / 60.0f);
        const float now = water.water().veil[0].x;
        EXPECT_GE(now, before);
        EXPECT_LE(now - before, 0.05f); // of the change of 1: no step that an eye takes for a flash
        before = now;
    }
    EXPECT_NEAR(before, 1.0f, 0.01f);                   // nine tenths of the way
    EXPECT_LT(water.water().attenuation_perM.x, 0.25f); // slower
    for (int i = 0; i < 1500; ++i) water.follow(after, 1, 1 / 60.0f);
    EXPECT_NEAR(water.water().attenuation_perM.x, 0.4f, 0.01f);
}

TEST(WaterOverTime, DoesNotDependOnHowOftenPicturesAreDrawn) {
    const auto end = [](int pictures) {
        WaterOverTime water;
        water.follow(estimateOf(glm::vec3(0.1f), 0.1f), 1, 0);
        for (int i = 0; i < pictures; ++i)
            water.follow(estimateOf(glm::vec3(1), 0.4f), 0.5f, 1.0f / static_cast<float>(pictures));
        return water.water();
    };
    EXPECT_NEAR(end(24).veil[0].x, end(240).veil[0].x, 1e-4f);
    EXPECT_NEAR(end(24).attenuation_perM.x, end(240).attenuation_perM.x, 1e-4f);
}

TEST(WaterOverTime, NoStrengthIsNoWater) {
    WaterOverTime water;
    EXPECT_TRUE(water.water().none()); // before anything was seen
    water.follow(estimateOf(glm::vec3(0.1f), 0.1f), 0, 0);
    EXPECT_TRUE(water.water().none());
}

} // namespace
} // namespace shoal::water
