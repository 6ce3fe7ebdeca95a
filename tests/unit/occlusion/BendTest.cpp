// Fish that bend: seen anew, or asked at rest through their skin.
#include "Animals.h"
#include "Measure.h"
#include "tests/baselines/occlusion/RebuiltOllfb.h"
#include "tests/baselines/occlusion/ThroughSkin.h"

#include <gtest/gtest.h>

namespace shoal::occlusion {
namespace {

struct Fish {
    scene::Model model = loadAnimal("clownfish");
    scene::Pose pose;
    Body rest;

    Fish() {
        scene::restPose(model, pose);
        rest = bodyOf(model, pose);
    }
    // The swimming clip's furthest bend.
    Body bent() {
        Body furthest = rest;
        const int swim = model.findAnimation("swim");
        const float duration = model.animations[static_cast<size_t>(swim)].duration_s;
        for (int i = 0; i < 8; ++i) {
            scene::animate(model, swim, duration * static_cast<float>(i) / 8, pose);
            scene::updateGlobals(model, pose);
            Body body = bodyOf(model, pose);
            if (bend_m(body.positions, rest.positions) > bend_m(furthest.positions, rest.positions))
                furthest = std::move(body);
        }
        return furthest;
    }
};

constexpr TracedOllfb::Options kFew{.views = 54, .sides = Sides::Outer};

TEST(Bend, IsRebuiltOnlyBeyondItsThreshold) {
    Fish fish;
    const Body bent = fish.bent();
    const float bend = bend_m(bent.positions, fish.rest.positions);
    ASSERT_GT(bend, 0.001f);
    RebuiltOllfb eager(kFew, bend * 0.9f), lazy(kFew, bend * 1.1f);
    for (RebuiltOllfb* each : {&eager, &lazy}) EXPECT_TRUE(each->follow(fish.rest.mesh()).value());
    EXPECT_FALSE(eager.follow(fish.rest.mesh()).value());
    EXPECT_TRUE(eager.follow(bent.mesh()).value());
    EXPECT_FALSE(lazy.follow(bent.mesh()).value());
}

TEST(Bend, GridTakesPosedPositionsBackToRest) {
    Fish fish;
    const Body bent = fish.bent();
    const TracedOllfb rest = TracedOllfb::make(fish.rest.mesh(), kFew).value();
    ThroughSkin skin(rest, fish.rest.positions);
    const float bend = bend_m(bent.positions, fish.rest.positions);
    for (size_t i = 0; i < bent.positions.size(); ++i)
        ASSERT_NEAR(glm::distance(skin.restFromPosed(fish.rest.positions[i]), fish.rest.positions[i]), 0,
                    1e-7f);
    skin.bend(bent.positions);
    double sum2 = 0;
    for (size_t i = 0; i < bent.positions.size(); ++i) {
        const double off =
            static_cast<double>(glm::distance(skin.restFromPosed(bent.positions[i]), fish.rest.positions[i]));
        sum2 += off * off;
    }
    const double rms = std::sqrt(sum2 / static_cast<double>(bent.positions.size()));
    std::printf("furthest bend %.1f mm; grid's RMS error %.3f mm\n", 1000 * static_cast<double>(bend),
                1000 * rms);
    EXPECT_LT(rms, 0.05 * static_cast<double>(bend));
}

TEST(Bend, RebuiltIsExactAndThroughTheSkinIsNear) {
    Fish fish;
    const Body bent = fish.bent();
    const float radius = boundingSphere(bent.mesh()).radius;
    const auto questions = ask(bent, 3000, false);
    const TracedOllfb rest = TracedOllfb::make(fish.rest.mesh(), kFew).value();
    ThroughSkin skin(rest, fish.rest.positions);
    skin.bend(bent.positions);
    RebuiltOllfb rebuilt(kFew, 0);
    ASSERT_TRUE(rebuilt.follow(bent.mesh()));
    const Errors unbent = measure(rest, questions, radius), through = measure(skin, questions, radius),
                 exact = measure(rebuilt, questions, radius);
    std::printf(
        "gaps of chords: left at rest %.2f %%, through the skin %.2f %%, rebuilt %.2f %%; off by %.5f, %.5f, "
        "%.5f r\n",
        100 * unbent.gaps(), 100 * through.gaps(), 100 * exact.gaps(), unbent.distance, through.distance,
        exact.distance);
    EXPECT_LE(exact.gaps(), 0.01);
    EXPECT_LE(through.gaps(), 0.02);
    EXPECT_LE(exact.gaps(), through.gaps());
    EXPECT_LE(through.gaps(), unbent.gaps() / 2);
    EXPECT_LE(skin.bytes(), rebuilt.bytes() / 4);
}

} // namespace
} // namespace shoal::occlusion
