// Combos, goals, free swim, and what stings.
#include "Fixture.h"

namespace shoal::game {
namespace {

TEST(Score, ComboCountsDifferentSpeciesInARow) {
    Score score = {.species = std::vector<SpeciesTally>(8)};
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
    Score score = {.species = std::vector<SpeciesTally>(4)};
    const Goal two{GoalKind::Catch, 2, 2}, any{GoalKind::Catch, -1, 3}, different{GoalKind::Different, -1, 2},
        points{GoalKind::Score, -1, 30}, none{GoalKind::NoLoss, -1, 2}, combo{GoalKind::Combo, -1, 2};
    for (const Goal& goal : {two, any, different, points, none, combo})
        EXPECT_FALSE(isReached(goal, score, true));
    score.countCatch(2, 10);
    EXPECT_EQ(progressOf(two, score), 1);
    EXPECT_FALSE(isReached(none, score, true)) << "nor before so many are caught";
    score.countCatch(2, 10);
    EXPECT_FALSE(isReached(none, score, false)) << "until the dive is over";
    EXPECT_TRUE(isReached(none, score, true));
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
    OneFish one({.change = [](DiveFile& file) {
        file.goals = {{GoalKind::Score, -1, 1000}, {GoalKind::Catch, -1, 1}, {GoalKind::NoLoss, -1, 1}};
    }});
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

// A dive whose events are made up.
struct Deedful {
    OpenDive world{cove().species, OneFish::lonely({}), 5};
    Score score{.species = std::vector<SpeciesTally>(cove().species.size())};

    void happen(Event event, float at_s = 0) {
        world.state().tick = static_cast<uint32_t>(at_s * 120);
        if (event.kind == EventKind::Catch) score.countCatch(event.species, 10);
        countForGoals(std::span(&event, 1), world.context(), score.goalCounts);
    }
    void caught(int species, float at_s, int hand = 1) {
        happen({.kind = EventKind::Catch, .creature = 0, .hand = hand, .species = species}, at_s);
    }
    int progress(const Goal& goal) const { return progressOf(goal, score); }
};

TEST(Goals, AQuickRunIsTheCatchesWithinSecondsOfTheLatest) {
    Deedful dive;
    const Goal quick{GoalKind::Quick, -1, 3, 10};
    EXPECT_EQ(dive.progress(quick), 0);
    dive.caught(1, 1);
    EXPECT_EQ(dive.progress(quick), 1);
    dive.caught(1, 8);
    EXPECT_EQ(dive.progress(quick), 2);
    dive.caught(1, 12);
    EXPECT_EQ(dive.progress(quick), 2) << "the first was too long ago";
    dive.caught(1, 18);
    EXPECT_TRUE(isReached(quick, dive.score, false));
    for (int i = 0; i < 2 * kMaxQuick; ++i) dive.caught(1, 20);
    EXPECT_EQ(dive.progress({GoalKind::Quick, -1, kMaxQuick, 1}), kMaxQuick);
}

TEST(Goals, TheFirstCatchDecidesAndEachHandCounts) {
    Deedful dive;
    const Goal first{GoalKind::First, 2, 1}, other{GoalKind::First, 3, 1}, each{GoalKind::EachHand, -1, 2};
    EXPECT_EQ(dive.progress(first), 0);
    dive.caught(2, 1, 0);
    dive.caught(3, 2, 0);
    EXPECT_EQ(dive.progress(first), 1);
    EXPECT_EQ(dive.progress(other), 0);
    EXPECT_EQ(dive.progress(each), 0);
    dive.caught(3, 3, 1);
    EXPECT_EQ(dive.progress(each), 1);
}

TEST(Goals, GuestsStonesTouchesAndFrightsCount) {
    Deedful dive;
    const Goal guests{GoalKind::Guests, -1, 2}, turn{GoalKind::TurnShark, -1, 1}, meet{GoalKind::Meet, -1, 3},
        calm{GoalKind::Calm, -1, 3};
    dive.happen({.kind = EventKind::Feed});
    dive.happen({.kind = EventKind::NoGuest});
    EXPECT_EQ(dive.progress(guests), 1);
    dive.happen({.kind = EventKind::SharkTurns});
    EXPECT_TRUE(isReached(turn, dive.score, false));
    for (const int species : {1, 1, 3}) {
        dive.world.fish[0].species = species;
        dive.happen({.kind = EventKind::Touch, .creature = 0});
    }
    EXPECT_EQ(dive.progress(meet), 2);
    dive.caught(1, 1);
    dive.caught(1, 2);
    dive.happen({.kind = EventKind::Startle, .creature = 0});
    EXPECT_EQ(dive.progress(calm), 0);
    for (int i = 0; i < 3; ++i) dive.caught(1, 3);
    EXPECT_TRUE(isReached(calm, dive.score, false));
}

TEST(Goals, OneOfEachLevelIsDrawnBySeed) {
    std::vector<Goal> all;
    for (int i = 0; i < 12; ++i)
        all.push_back({.kind = GoalKind::Catch, .species = i, .count = 1, .level = 1 + i % 3});
    std::set<int> seen;
    for (uint64_t seed = 1; seed < 100; ++seed) {
        const std::vector<int> drawn = drawGoals(all, seed);
        ASSERT_EQ(drawn.size(), 3u);
        for (int level = 0; level < 3; ++level) EXPECT_EQ(drawn[level] % 3, level);
        EXPECT_EQ(drawGoals(all, seed), drawn);
        seen.insert(drawn.begin(), drawn.end());
    }
    EXPECT_EQ(seen.size(), all.size());
    for (Goal& goal : all) goal.species = goal.level == 3 ? 7 : -1;
    EXPECT_EQ(drawGoals(all, 1).size(), 2u) << "never two that are alike";
    all.resize(2);
    EXPECT_EQ(drawGoals(all, 1), (std::vector<int>{0, 1})) << "so few are all kept";
}

TEST(Goals, ADiveShowsThoseThatItHasDrawnAndDrawsAnewAfterARestart) {
    DiveFile file = calmCove();
    file.goals.clear();
    for (int i = 0; i < 30; ++i) file.goals.push_back({GoalKind::Catch, i, 1, 0, 1 + i % 3});
    OpenDive dive(cove().species, file, 3);
    const auto shown = [&] {
        std::vector<int> goals;
        for (const GoalView& view : dive.shown().goals) goals.push_back(view.goal);
        return goals;
    };
    EXPECT_EQ(shown(), drawGoals(file.goals, 3));
    const uint64_t hash = dive.stateHash();
    dive.state().score.goals[0] += 3;
    EXPECT_NE(dive.stateHash(), hash);
    dive.input.restart = true;
    dive.step();
    EXPECT_EQ(shown(), drawGoals(file.goals, 4));
}

// Goals that a dive cannot offer would lock a star.
TEST(Goals, ThoseOfTheGameCanBeReached) {
    for (const std::string& name : diveNames()) {
        const DiveFiles files = tests::valueOf(loadDiveFiles(name));
        const auto shown = speciesShown(files.species, files.dive);
        const auto number = [&](int species, auto fits) {
            int count = 0;
            for (const School& school : files.dive.schools)
                if (school.stars == 0 && (species < 0 || school.species == species) &&
                    fits(files.species[school.species]))
                    count += species < 0 ? 1 : school.count;
            return count;
        };
        const auto thing = [](Thing wanted) { return [=](const Species& s) { return s.thing == wanted; }; };
        EXPECT_GE(files.dive.goals.size(), 12u);
        for (int level = 1; level <= 3; ++level)
            EXPECT_GE(std::ranges::count(files.dive.goals, level, &Goal::level), 4) << name;
        for (const Goal& goal : files.dive.goals) {
            SCOPED_TRACE(name + ", " + kGoalNames[static_cast<size_t>(goal.kind)]);
            if (goal.species >= 0) {
                EXPECT_TRUE(shown[goal.species]);
                if (files.species[goal.species].thing == Thing::Bottle) {
                    EXPECT_GE(number(goal.species, thing(Thing::Bottle)), goal.count);
                }
            }
            if (goal.kind == GoalKind::Different || goal.kind == GoalKind::Combo ||
                goal.kind == GoalKind::Meet) {
                EXPECT_GE(number(-1, isFish), goal.count);
            }
            if (goal.kind == GoalKind::Guests) {
                EXPECT_GE(number(findSpecies(files.species, "mussel"), thing(Thing::Mussel)), goal.count);
            }
            if (goal.kind == GoalKind::NoLoss || goal.kind == GoalKind::TurnShark) {
                EXPECT_GE(files.dive.shark.species, 0);
            }
        }
    }
}

TEST(RareAnimals, ComeToPlayersWithStarsAndChangeNothingForOthers) {
    DiveFile file = calmCove();
    const auto hashOf = [](const DiveFile& dive, int stars) {
        return Dive(cove().species, dive, 7, {.stars = stars}).stateHash();
    };
    const uint64_t without = hashOf(file, 0);
    School rare = file.schools[0];
    rare.count = 1;
    rare.stars = 10;
    file.schools.push_back(rare);
    EXPECT_EQ(hashOf(file, 0), without);
    EXPECT_EQ(hashOf(file, 9), without);
    EXPECT_NE(hashOf(file, 10), without);
    const size_t count = Dive(cove().species, file, 7).state().fish.size();
    EXPECT_EQ(Dive(cove().species, file, 7, {.stars = 11}).state().fish.size(), count + 1);
}

TEST(RareAnimals, EachDiveOfTheGameHasOneForTenStars) {
    int forTwenty = 0;
    for (const std::string& name : diveNames()) {
        const DiveFiles files = tests::valueOf(loadDiveFiles(name));
        EXPECT_EQ(std::ranges::count(files.dive.schools, 10, &School::stars), 1) << name;
        forTwenty += static_cast<int>(std::ranges::count(files.dive.schools, 20, &School::stars));
        for (const School& school : files.dive.schools)
            if (school.stars > 0) {
                EXPECT_TRUE(std::filesystem::exists(dataRoot() / "content/guide" /
                                                    (files.species[school.species].name + ".dark.png")));
            }
    }
    EXPECT_EQ(forTwenty, 1);
}

TEST(FreeSwim, HasNoClockAndNoShark) {
    OneFish one({.shark = true, .rules = {.freeSwim = true}});
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
    OpenDive world(species, OneFish::lonely({}), 5, {Assist::Strong});
    for (int i = 0; i <= 40; ++i) {
        world.fish[0].position = kPlace;
        world.fish[0].velocity = glm::vec3(0);
        world.input.hands[1] = handAt(kPlace, std::clamp(static_cast<float>(i - 10) / 15, 0.0f, 1.0f));
        world.step();
    }
    EXPECT_EQ(count<EventKind::Sting>(world.events), 1);
    EXPECT_EQ(count<EventKind::Grab>(world.events), 0);
    EXPECT_EQ(world.fish[0].catchable, 0) << "what stings is not offered";
    EXPECT_GT(world.hands[1].stung_s, 0.5f);
    EXPECT_LE(world.hands[1].stung_s, kSting_s);
}

TEST(Replays, CarryTheirRules) {
    const DiveRules rules{Assist::Strong, true, true, 12, 160};
    const Dive dive(cove().species, cove().dive, 3, rules);
    sim::RecordingHeader header = recordingHeader(dive);
    ASSERT_TRUE(rulesOf(header));
    EXPECT_EQ(*rulesOf(header), rules);
    header.settings["assist"] = "magic";
    EXPECT_FALSE(rulesOf(header));
    header.settings["assist"] = "none";
    header.settings["stars"] = "-1";
    EXPECT_FALSE(rulesOf(header));
    header.settings["stars"] = "0";
    header.settings["room_floor_cm"] = "301";
    EXPECT_FALSE(rulesOf(header));
    header.settings.erase("room_floor_cm"); // of an earlier version
    header.settings.erase("stars");
    EXPECT_EQ(tests::valueOf(rulesOf(header)).stars, 0);
}

const std::vector<VideoMark> kEnclosures = {{10, 14, 0.5f}, {14, 20, 1}};

TEST(Enclosure, RisesBeforeAMarkStaysAndFades) {
    const auto at = [](double time_s) { return enclosureAt(kEnclosures, 60, time_s); };
    EXPECT_EQ(at(0), 0);
    EXPECT_EQ(at(8), 0);
    EXPECT_FLOAT_EQ(at(9), 0.25f);
    EXPECT_FLOAT_EQ(at(11), 0.5f);
    EXPECT_FLOAT_EQ(at(13.5), 0.75f); // the tunnel comes nearer
    EXPECT_FLOAT_EQ(at(14), 1);
    EXPECT_FLOAT_EQ(at(20), 1);
    EXPECT_FLOAT_EQ(at(21), 0.5f);
    EXPECT_EQ(at(22), 0);
}

TEST(Enclosure, FollowsTheVideoAroundItsEnd) {
    EXPECT_FLOAT_EQ(enclosureAt(kEnclosures, 60, 60 + 15), 1);
    EXPECT_FLOAT_EQ(enclosureAt(kEnclosures, 60, 120 + 9), 0.25f);
    const std::vector<VideoMark> atTheEnd = {{58, 60, 1}};
    EXPECT_FLOAT_EQ(enclosureAt(atTheEnd, 60, 61), 0.5f); // fades into the next pass
    const std::vector<VideoMark> atTheStart = {{0, 3, 1}};
    EXPECT_FLOAT_EQ(enclosureAt(atTheStart, 60, 59), 0.5f);
}

TEST(Enclosure, MarksOfALongerVideoAreNotHeard) {
    EXPECT_EQ(enclosureAt(kEnclosures, 6, 5.9), 0);
    EXPECT_EQ(enclosureAt(kEnclosures, 0, 15), 0); // no video
    EXPECT_FLOAT_EQ(enclosureAt(kEnclosures, 12, 11), 0.5f);
}

TEST(Enclosure, TheSnapshotCarriesItAndARestartBeginsAnew) {
    DiveFile file = cove().dive;
    file.enclosure = {{1, 2, 1}};
    file.videoLength_s = 10;
    OpenDive dive(cove().species, file, 3);
    dive.step(180);
    EXPECT_EQ(dive.shown().enclosure, 1);
    dive.input.restart = true;
    dive.step();
    EXPECT_NEAR(dive.shown().enclosure, 0.5f, 0.01f); // a second before the mark
    dive.input = {.pause = true};
    dive.step(240);
    EXPECT_NEAR(dive.shown().enclosure, 0.5f, 0.01f);
}

constexpr glm::vec3 kFrom{-20, 5, -6}, kTo{20, 5, -6};
constexpr float kAt_s = 2, kSpeed_mps = 2;

const CreatureView* whaleOf(const Dive& dive, const Snapshot& shown) {
    for (const CreatureView& creature : shown.creatures)
        if (dive.species()[static_cast<size_t>(creature.species)].giant) return &creature;
    return nullptr;
}

TEST(Encounter, PassesOnceFromOnePlaceToTheOther) {
    DiveFiles files = cove();
    const size_t whale = files.species.size();
    files.species.push_back(
        {.name = "whale", .giant = true, .length_m = 12, .cruise_mps = kSpeed_mps, .stride = 1});
    files.dive.encounter = {static_cast<int>(whale), kAt_s, kFrom, kTo};
    Dive dive(files.species, files.dive, 1);
    Snapshot shown;
    int events = 0;
    for (int tick = 1; tick <= 30 * 120; ++tick) {
        Events happened;
        dive.step({}, happened);
        dive.snapshot(shown);
        const float passed_s = static_cast<float>(tick) * kDt - kAt_s;
        const float passed_m = passed_s * kSpeed_mps;
        const CreatureView* seen = whaleOf(dive, shown);
        if (passed_s < -kDt || passed_m > glm::distance(kFrom, kTo) + 0.1f) {
            EXPECT_FALSE(seen) << passed_s;
        } else if (passed_s > kDt && passed_m < glm::distance(kFrom, kTo) - 0.1f) {
            ASSERT_TRUE(seen) << passed_s;
            EXPECT_EQ(&shown.creatures[seen->id], seen) << "its id is its place";
            // Two ticks' way: the one in which it sets out, and rounding over thousands.
            EXPECT_LT(glm::distance(seen->position, kFrom + glm::vec3(passed_m, 0, 0)), 2 * kDt * kSpeed_mps);
            EXPECT_LT(glm::distance(seen->worldFromBody * glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)), 1e-4f);
            EXPECT_NEAR(seen->shape.beats, passed_m / 12, 0.01f) << "a stride of its length";
        }
        for (const Event& event : happened) {
            if (event.kind != EventKind::Encounter) continue;
            ++events;
            EXPECT_GT(glm::dot(glm::normalize(*event.position), glm::normalize(kFrom)), 0.999f)
                << "heard from where it comes";
        }
    }
    EXPECT_EQ(events, 1);
    EXPECT_TRUE(shown.tally[whale].touched) << "met";
    EXPECT_FALSE(whaleOf(dive, shown));
}

TEST(Encounter, ItsSpeciesIsShownAndNoOneElseMissed) {
    const SpeciesTable& species = cove().species;
    DiveFile empty;
    EXPECT_THAT(speciesShown(species, empty), testing::Each(false));
    empty.encounter.species = 0;
    empty.shark.species = 2;
    empty.schools.push_back({.species = 1});
    const auto shown = speciesShown(species, empty);
    EXPECT_EQ(std::vector(shown.begin(), shown.begin() + 3), std::vector({true, true, true}));
    EXPECT_EQ(std::ranges::count(shown, true), 3);
}

} // namespace
} // namespace shoal::game
