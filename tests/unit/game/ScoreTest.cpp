// Combos, goals, free swim, and what stings.
#include "Fixture.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::game {
namespace {

using test::count;
using test::cove;
using test::first;
using test::kPlace;

TEST(Score, ComboCountsDifferentSpeciesInARow) {
    Score score = newScore(SpeciesTable(8), DiveFile{});
    EXPECT_EQ(score.combo(), 0);
    EXPECT_EQ(score.countCatch(3, 10), 10);
    EXPECT_EQ(score.countCatch(1, 25), 50);
    EXPECT_EQ(score.countCatch(7, 20), 60);
    EXPECT_EQ(score.countCatch(1, 25), 25) << "a repeat begins a new run with itself";
    EXPECT_EQ(score.countCatch(3, 10), 20);
    score.countLoss(3);
    EXPECT_EQ(score.combo(), 0);
    for (int kind = 0; kind < 8; ++kind)
        EXPECT_EQ(score.countCatch(kind, 10), 10 * std::min(kind + 1, kMaxCombo)) << kind;
    EXPECT_EQ(score.bestCombo, kMaxCombo);
    EXPECT_EQ(score.points, 165 + 300);
    EXPECT_EQ(score.caught, 13);
    EXPECT_EQ(score.species[1].caught, 3);
    EXPECT_EQ(score.species[3].lost, 1);
}

TEST(Score, GoalsAreReachedByWhatTheyCount) {
    Score score = newScore(SpeciesTable(4), DiveFile{});
    const Goal two{GoalKind::Catch, 2, 2}, any{GoalKind::Catch, -1, 3}, different{GoalKind::Different, -1, 2},
        points{GoalKind::Score, -1, 30}, none{GoalKind::NoLoss, -1, 1}, combo{GoalKind::Combo, -1, 2};
    for (const Goal& goal : {two, any, different, points, none, combo})
        EXPECT_FALSE(isReached(goal, score, true));
    score.countCatch(2, 10);
    EXPECT_EQ(progressOf(two, score), 1);
    EXPECT_FALSE(isReached(none, score, false)) << "until the dive is over";
    EXPECT_TRUE(isReached(none, score, true));
    score.countCatch(2, 10);
    EXPECT_TRUE(isReached(two, score, false));
    EXPECT_FALSE(isReached(combo, score, false));
    score.countCatch(0, 10);
    for (const Goal& goal : {two, any, different, points, combo}) {
        EXPECT_TRUE(isReached(goal, score, false));
        EXPECT_LE(progressOf(goal, score), goal.count) << "no more than asked for";
    }
    score.countLoss(1);
    EXPECT_FALSE(isReached(none, score, true));
}

TEST(Score, ACatchTellsWhatItGaveAndReachesItsGoalOnce) {
    test::OneFish one(false, {}, [](DiveFile& file) {
        file.goals = {{GoalKind::Score, -1, 1000}, {GoalKind::Catch, -1, 1}, {GoalKind::NoLoss, -1, 1}};
    });
    one.closeOn();
    one.step(130);
    const Event* caught = first<EventKind::Catch>(one.events);
    ASSERT_NE(caught, nullptr);
    EXPECT_EQ(caught->species, one.fish().species);
    EXPECT_EQ(caught->points, one.world.species()[one.fish().species].points);
    EXPECT_EQ(caught->combo, 1);
    const Event* goal = first<EventKind::Goal>(one.events);
    ASSERT_NE(goal, nullptr);
    EXPECT_EQ(goal->goal, 1);
    const Snapshot now = one.shown();
    ASSERT_EQ(now.goals.size(), 3u);
    EXPECT_TRUE(now.goals[1].reached);
    EXPECT_FALSE(now.goals[0].reached || now.goals[2].reached);
    const SpeciesTally& tally = now.tally[static_cast<size_t>(one.fish().species)];
    EXPECT_EQ(tally.caught, 1);
    EXPECT_TRUE(tally.touched);
    one.step(static_cast<int>(one.world.file().duration_s) * 120);
    EXPECT_EQ(count<EventKind::Goal>(one.events), 2) << "nothing was lost";
    EXPECT_EQ(one.world.state().phase, Phase::Results);
}

TEST(FreeSwim, HasNoClockAndNoShark) {
    test::OneFish one(true, {.freeSwim = true});
    one.step(static_cast<int>(2 * one.world.file().duration_s * 120));
    const Snapshot now = one.shown();
    EXPECT_EQ(now.phase, Phase::Diving);
    EXPECT_TRUE(now.freeSwim);
    EXPECT_EQ(now.timeLeft_s, one.world.file().duration_s);
    EXPECT_EQ(now.creatures.size(), 1u) << "the fish alone";
    EXPECT_EQ(count<EventKind::SharkNear>(one.events) + count<EventKind::DiveOver>(one.events), 0);
}

TEST(Sting, AHandThatClosesOnAJellyfishCannotHoldForASecond) {
    SpeciesTable species = cove().species;
    for (Species& kind : species) kind.stings = !kind.shark;
    test::OpenDive world(species, test::OneFish::lonely(false), 5, {Assist::Strong});
    TickInput input;
    Events events;
    for (int i = 0; i <= 40; ++i) {
        world.fish[0].position = kPlace;
        world.fish[0].velocity = glm::vec3(0);
        input.hands[1] = test::handAt(kPlace, std::clamp(static_cast<float>(i - 10) / 15, 0.0f, 1.0f));
        world.step(input, events);
    }
    EXPECT_EQ(count<EventKind::Sting>(events), 1);
    EXPECT_EQ(count<EventKind::Grab>(events), 0);
    EXPECT_EQ(world.fish[0].catchable, 0) << "what stings is not offered";
    Snapshot now;
    world.snapshot(now);
    EXPECT_GT(now.hands[1].stung_s, 0.5f);
    EXPECT_LE(now.hands[1].stung_s, kSting_s);
}

TEST(Replays, CarryTheirRules) {
    const DiveRules rules{Assist::Strong, true, true};
    const Dive dive(cove().species, cove().dive, 3, rules);
    sim::RecordingHeader header = recordingHeader(dive);
    ASSERT_TRUE(rulesOf(header));
    EXPECT_EQ(*rulesOf(header), rules);
    header.settings["assist"] = "magic";
    EXPECT_FALSE(rulesOf(header));
}

} // namespace
} // namespace shoal::game
