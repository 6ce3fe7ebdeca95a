#include "game/app/FirstSteps.h"

#include "game/rules/DiveFile.h"
#include "tests/TestRig.h"

#include <gtest/gtest.h>

#include <memory>

namespace shoal::app {
namespace {

using Step = FirstSteps::Step;

constexpr float kFrame_s = 1.0f / 60;

glm::quat turned(float angle_rad) { return glm::angleAxis(angle_rad, glm::vec3(0, 1, 0)); }

struct Pupil {
    game::SpeciesTable species{{.name = "jellyfish", .stings = true}, {.name = "snapper"}};
    FirstSteps steps{tests::rig(), species};
    game::Snapshot shown;

    void follow(float seconds) {
        for (float t = 0; t < seconds; t += kFrame_s) steps.follow(shown, kFrame_s);
    }
};

TEST(FirstSteps, LeadFromLookingToHolding) {
    Pupil p;
    p.shown.creatures = {{.species = 1, .position = {0, 0, -1}}};
    p.follow(1);
    EXPECT_EQ(p.steps.step(), Step::Look);
    p.shown.worldFromView = turned(1.1f * FirstSteps::kTurned_rad);
    p.follow(0.1f);
    EXPECT_EQ(p.steps.step(), Step::Reach);
    p.shown.creatures[0].catchable = 1;
    p.follow(0.5f * FirstSteps::kNear_s);
    EXPECT_EQ(p.steps.step(), Step::Reach) << "the hand only swept past the fish";
    p.follow(FirstSteps::kNear_s);
    EXPECT_EQ(p.steps.step(), Step::Hold);
    p.shown.caught = 1;
    p.follow(0.1f);
    EXPECT_EQ(p.steps.step(), Step::Done);
}

// The fish that was in reach has swum on: there is nothing to close the hand on.
TEST(FirstSteps, HoldingWaitsForAFishInReach) {
    Pupil p;
    p.shown.creatures = {{.species = 1, .position = {0, 0, -1}, .catchable = 1}};
    p.follow(0.1f);
    p.shown.worldFromView = turned(1.1f * FirstSteps::kTurned_rad);
    p.follow(1);
    ASSERT_EQ(p.steps.step(), Step::Hold);
    p.shown.creatures[0].catchable = 0;
    p.shown.hands[0].holds = 0;
    p.follow(2 * FirstSteps::kAway_s);
    EXPECT_EQ(p.steps.step(), Step::Hold) << "it is in the hand";
    p.shown.hands[0].holds = -1;
    p.follow(0.5f * FirstSteps::kAway_s);
    EXPECT_EQ(p.steps.step(), Step::Hold);
    p.follow(FirstSteps::kAway_s);
    EXPECT_EQ(p.steps.step(), Step::Reach);
}

TEST(FirstSteps, ACatchSkipsThemAll) {
    Pupil p;
    p.shown.caught = 1;
    p.follow(0.1f);
    EXPECT_EQ(p.steps.step(), Step::Done);
}

// A tracked head trembles by a tenth of a degree.
TEST(FirstSteps, ATremblingHeadHasNotLookedAround) {
    Pupil p;
    for (int i = 0; i < 60 * 60; ++i) {
        p.shown.worldFromView = turned(i % 2 ? 0.002f : -0.002f);
        p.follow(kFrame_s / 2);
    }
    EXPECT_EQ(p.steps.step(), Step::Look);
}

TEST(FirstSteps, TheGhostHandReachesForNothingThatStings) {
    Pupil p;
    p.shown.creatures = {{.species = 0, .position = {0, 0, -0.9f}}};
    p.follow(0.1f);
    EXPECT_FALSE(p.steps.target());
    p.shown.creatures.push_back({.species = 1, .position = {0.2f, 0, -1}});
    p.follow(1.1f * FirstSteps::kShown_s);
    ASSERT_TRUE(p.steps.target());
    EXPECT_EQ(*p.steps.target(), p.shown.creatures[1].position);
}

// First steps are made from a copy of the session, which no longer exists when they are drawn.
TEST(FirstSteps, TheGhostHandDoesNotDependOnWhatItWasMadeFrom) {
    auto rig = std::make_unique<hands::HandRig>(tests::rig());
    const FirstSteps steps(*rig, {});
    *rig = {};
    rig.reset();
    const render::View view;
    const hands::HandPose ghost = steps.ghost(view), whole = FirstSteps(tests::rig(), {}).ghost(view);
    for (size_t i = 0; i < ghost.joints.size(); ++i)
        EXPECT_EQ(ghost.joints[i].position, whole.joints[i].position) << i;
}

TEST(Hints, StopOnceTheyAreUnderstood) {
    const game::Events tooFast{{.kind = game::EventKind::MissTooFast}};
    const auto timesSaid = [&](int caught) {
        Hints hints;
        game::Snapshot shown;
        shown.caught = caught;
        int said = 0;
        for (int i = 0; i < 10; ++i) {
            hints.follow(shown, tooFast, 0.1f);
            const auto hint = hints.shown();
            said += hint && hint->in(game::Language::English) == std::string("A fast hand frightens fish");
            hints.follow(shown, {}, Hints::kStay_s);
        }
        return said;
    };
    EXPECT_EQ(timesSaid(0), Hints::kTimes);
    EXPECT_EQ(timesSaid(Hints::kUnderstood), 0);
}

} // namespace
} // namespace shoal::app
