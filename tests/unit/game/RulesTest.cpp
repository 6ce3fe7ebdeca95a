// The rules of catching, one at a time.
#include "Fixture.h"

namespace shoal::game {
namespace {

TEST(Catching, ClosingOnAFishGrabsAndASecondLaterItCounts) {
    OneFish one;
    one.takeFish();
    const Event* grab = first<EventKind::Grab>(one.events);
    ASSERT_NE(grab, nullptr);
    EXPECT_EQ(grab->hand, 1);
    EXPECT_EQ(grab->creature, 0);
    const Snapshot now = one.shown();
    EXPECT_EQ(now.hands[1].holds, 0);
    EXPECT_EQ(now.creatures[0].heldBy, 1);
    EXPECT_EQ(now.creatures[0].gait.motion, Motion::Struggle);

    const uint64_t grabbed = one.tickOfFirst<EventKind::Grab>();
    while (one.world.state().totalTicks < grabbed + 119) one.step();
    EXPECT_EQ(count<EventKind::Catch>(one.events), 0);
    one.step();
    EXPECT_EQ(count<EventKind::Catch>(one.events), 1) << "120 ticks after the grab";
    EXPECT_EQ(one.world.score.caught, 1);
    EXPECT_EQ(one.world.score.points, one.world.species()[one.fish().species].points);
    const Event* caught = first<EventKind::Catch>(one.events);
    EXPECT_FLOAT_EQ(caught->length_m, one.world.species()[one.fish().species].length_m);
    EXPECT_NEAR(caught->mass_kg, 0.044f, 0.001f); // 20 kg/m3 times the cube of 0.13 m

    // The hand is free at once; the fish turns its side to the player, then swims off.
    EXPECT_EQ(one.held(), -1);
    one.step(60);
    EXPECT_EQ(one.fish().state, Fish::State::Shown);
    EXPECT_EQ(count<EventKind::Release>(one.events), 0);
    EXPECT_LT(std::abs(glm::dot(one.fish().forward, glm::normalize(one.fish().position))), 0.5f);
    one.step(31);
    EXPECT_EQ(count<EventKind::Release>(one.events), 1);
    EXPECT_EQ(count<EventKind::Escape>(one.events) + count<EventKind::Miss>(one.events), 0);

    // For two seconds nobody catches it again.
    one.moveGrip(kPlace, 1, 0);
    one.step(30);
    EXPECT_GT(glm::distance(one.fish().position, kPlace), 0.1f);
    one.rest();
    one.moveGrip(kPlace, 0, 1);
    one.step(kCloseWindow);
    EXPECT_EQ(count<EventKind::Grab>(one.events), 1);
    EXPECT_EQ(count<EventKind::Miss>(one.events), 1);
}

TEST(Catching, AHandThatVanishesKeepsItsFishForAMomentOnly) {
    OneFish one;
    one.takeFish();
    one.input.hands[1].tracked = false;
    one.step(20);
    EXPECT_EQ(one.held(), 0);
    one.step(60);
    EXPECT_EQ(one.held(), -1);
    EXPECT_EQ(count<EventKind::Escape>(one.events), 1);
}

TEST(Touching, AGentleStrokePushesAwayAndIsFeltForAsLongAsItLasts) {
    OneFish one;
    const glm::vec3 left = kPlace - glm::vec3(0.3f, 0, 0.02f); // the back of a right hand faces the fish
    one.hand(left);
    int felt = 0;
    float fastest = 0;
    glm::vec3 push(0);               // at the first touch
    for (int i = 0; i <= 160; ++i) { // 0.2 m/s
        one.rest();
        one.hand(left + glm::vec3(0.2f * static_cast<float>(i) / 120, 0, 0));
        if (push == glm::vec3(0)) push = one.fish().push;
        for (const TouchView& touch : one.world.hands[1].touching) {
            if (!touch.touches) continue;
            ++felt;
            fastest = std::max(fastest, touch.press_mps);
            EXPECT_EQ(touch.struggle, 0) << "it is not held";
        }
    }
    const Event* touch = first<EventKind::Touch>(one.events);
    ASSERT_NE(touch, nullptr);
    EXPECT_LT(touch->closing_mps, 0.25f);
    EXPECT_GE(touch->part, 0);
    EXPECT_LE(touch->part, hands::kPalmPart);
    EXPECT_EQ(count<EventKind::Startle>(one.events), 0);
    EXPECT_GT(push.x, 0.03f) << "away from the hand";
    EXPECT_LT(glm::length(push), 0.3f) << "gently";
    EXPECT_GT(felt, 10);
    EXPECT_LT(fastest, 0.3f) << "as slow as the hand";
}

// A hand that a turning head takes along does not frighten fish, though one moved as fast would.
TEST(Fright, AHeadThatTurnsFrightensNobody) {
    OneFish one;
    for (int i = 0; i < 30; ++i) { // 3.6 rad/s at 0.6 m: 2.2 m/s
        one.input.worldFromView = glm::angleAxis(0.03f * static_cast<float>(20 - i), glm::vec3(0, 1, 0));
        one.rest({-0.02f, -0.1f, -0.7f});
        one.hand(kPlace);
    }
    EXPECT_EQ(count<EventKind::Startle>(one.events), 0);
}

// Hands are given in the viewer's frame, so that a head that leans takes them along.
TEST(Head, HandsGoWhereTheHeadGoes) {
    OneFish one;
    one.hand(kPlace + glm::vec3(0.3f, 0, 0));
    const glm::vec3 before = one.world.hands[1].joints[10].position;
    one.input.headWorld = {0.2f, -0.1f, 0.05f};
    one.step();
    EXPECT_EQ(one.shown().headWorld, one.input.headWorld);
    EXPECT_LT(glm::distance(one.shown().hands[1].joints[10].position, before + one.input.headWorld), 1e-6f);
}

// Fish and shark keep from the player's eyes, not from the place of the film's camera.
TEST(Head, AnimalsKeepFromTheEyesOfAPlayerWhoStepsAside) {
    OneFish one({.shark = true});
    one.input.headWorld = {0.5f, 0, -0.9f};
    one.step();
    one.rest(one.input.headWorld + glm::vec3(0.1f, 0, 0));
    one.world.shark.position = one.input.headWorld + glm::vec3(0, 0, -0.7f);
    one.step(60);
    EXPECT_GT(glm::distance(one.fish().position, one.input.headWorld), 0.35f);
    const Swimmer& shark = one.world.shark;
    EXPECT_GT(physics::separation(capsuleOf(shark, one.world.species()[one.world.shark.species]),
                                  physics::Capsule{one.input.headWorld, one.input.headWorld, 0}),
              0.55f);
}

TEST(BadInput, IsNotBelieved) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinite = std::numeric_limits<float>::infinity();
    OneFish one;
    one.hand(kPlace + glm::vec3(0.3f, 0, 0));
    one.step();
    const glm::vec3 good = one.world.hands[1].graspCentre;
    const auto bad = [&](auto spoil) {
        const TickInput sound = one.input;
        spoil(one.input);
        one.step();
        one.input = sound;
        EXPECT_EQ(one.world.hands[1].graspCentre, good);
        EXPECT_TRUE(one.world.hands[1].visible);
        EXPECT_TRUE(std::isfinite(one.fish().position.x));
        one.step();
    };
    for (const float value : {nan, infinite, -infinite, 1e30f, -40.0f}) {
        bad([&](TickInput& i) { i.hands[1].joints[4].position.x = value; });
        bad([&](TickInput& i) { i.hands[1].joints[20].position = glm::vec3(value); });
        bad([&](TickInput& i) { i.hands[1].joints[0].orientation.w = value; });
        bad([&](TickInput& i) { i.hands[1].joints[9].radius = value; });
        bad([&](TickInput& i) { i.headWorld = {0, value, 0}; });
    }
    bad([&](TickInput& i) { i.hands[1].joints[7].orientation = {0, 0, 0, 0}; });
    bad([&](TickInput& i) { i.hands[1].grip = nan; });
    bad([&](TickInput& i) { i.worldFromView = {nan, 0, 0, 0}; });
    bad([&](TickInput& i) { i.worldFromView = {0, 0, 0, 0}; });
    // For long: the hand is gone, nothing else happens; the first sound pose brings it back.
    const TickInput sound = one.input;
    one.input.hands[1].joints[4].position.x = nan;
    one.step(200);
    EXPECT_FALSE(one.world.hands[1].visible);
    one.input = sound;
    one.step();
    EXPECT_TRUE(one.world.hands[1].visible);
    EXPECT_EQ(count<EventKind::Touch>(one.events), 0);
}

// For a seated player, who cannot step or bend, fish circle above the lap, and nearer.
TEST(Seated, FishCircleWhereTheyAreReached) {
    const Dive dive(cove().species, cove().dive, 3, {.seated = true});
    EXPECT_EQ(dive.file().floor_m, -0.9f); // the floor of a room in which somebody sits
    for (size_t i = 0; i < cove().dive.schools.size(); ++i) {
        const School &sits = dive.file().schools[i], &stands = cove().dive.schools[i];
        EXPECT_GE(sits.heightLow_m, -0.45f);
        EXPECT_LT(sits.heightLow_m, sits.heightHigh_m);
        EXPECT_LT(sits.radiusHigh_m, stands.radiusHigh_m - 0.2f);
        EXPECT_LT(sits.radiusLow_m, sits.radiusHigh_m);
    }
}

TEST(Course, DiveEndsInResultsAndRestartsWithTheNextSeed) {
    OneFish one;
    one.step(static_cast<int>(one.world.file().duration_s * 120) - 1);
    EXPECT_EQ(one.world.state().phase, Phase::Diving);
    EXPECT_EQ(count<EventKind::DiveStart>(one.events), 1);
    one.step(2);
    EXPECT_EQ(one.world.state().phase, Phase::Results);
    EXPECT_EQ(count<EventKind::DiveOver>(one.events), 1);
    // Nothing is caught once the results are shown.
    one.closeOn();
    EXPECT_FALSE(one.took());
    one.input.restart = true;
    one.step(50); // held down: one restart
    EXPECT_EQ(one.world.seed(), 6u);
    EXPECT_EQ(one.world.state().phase, Phase::Diving);
    EXPECT_EQ(one.world.state().tick, 50u);
    EXPECT_EQ(count<EventKind::DiveStart>(one.events), 2);
    EXPECT_EQ(one.world.score.points, 0);
}

TEST(Course, PauseFreezes) {
    OneFish one({.shark = true});
    one.step(10);
    one.input.pause = true;
    one.step();
    const uint64_t frozen = one.world.stateHash();
    one.step(500);
    EXPECT_EQ(one.world.stateHash(), frozen);
    EXPECT_TRUE(one.shown().paused);
    one.input.pause = false;
    one.step();
    EXPECT_EQ(one.world.state().tick, 11u);
}

// A dive of one fish and a shark that prowls at a place and looks at kPlace.
struct SharkAt : OneFish {
    Shark& shark = world.shark;

    explicit SharkAt(glm::vec3 at) : OneFish({.shark = true}) {
        shark.position = at;
        shark.forward = glm::normalize(kPlace - at);
        shark.set(Shark::State::Prowl);
        shark.visit_s = 10;
    }
    bool pointsAtHand() const {
        return glm::dot(shark.forward, glm::normalize(world.hands[1].graspCentre - shark.position)) > 0.9f;
    }
};

TEST(SharkRules, TakesAStrugglingFishOutOfAHandAndLeaves) {
    SharkAt one({0.3f, -0.1f, -3.6f});
    one.moveGrip(kPlace, 0, 0);
    // It points at the open hand before anything is in it.
    int threatened = 0;
    while (one.shark.state != Shark::State::Threaten || one.shark.aimed_s < 1.1f) {
        one.rest();
        one.step();
        ASSERT_LT(++threatened, 400);
    }
    one.rest();
    EXPECT_TRUE(one.pointsAtHand());
    EXPECT_LT(one.shark.speed, 0.5f * one.world.species()[one.shark.species].cruise_mps);
    EXPECT_GT(one.shark.shape.finsDown, 0.5f) << "fins lowered";
    EXPECT_GT(one.shark.shape.bendUp, 0.3f) << "back arched";
    one.moveGrip(kPlace, 0, 1);
    ASSERT_EQ(one.held(), 0);
    one.step(115);
    const Event* steal = first<EventKind::SharkSteal>(one.events);
    ASSERT_NE(steal, nullptr);
    EXPECT_EQ(steal->hand, 1);
    EXPECT_EQ(one.world.score.lost, 1);
    EXPECT_EQ(one.world.score.caught, 0);
    EXPECT_EQ(one.held(), -1);
    EXPECT_EQ(one.shark.state, Shark::State::Leave);
    one.input.hands[1].tracked = false;
    one.step(1800);
    EXPECT_EQ(one.shark.mouth, -1);
    EXPECT_EQ(one.fish().state, Fish::State::Cruise) << "it got away and came back";
    EXPECT_EQ(count<EventKind::SharkSteal>(one.events), 1);
}

// A hand holds one fish after the other before a shark, which points at it before each strike. From its
// warning to the bite pass kWarned_s, and the fish is in the hand for kGrasped_s of them.
TEST(SharkRules, NeverStrikesUnannounced) {
    int strikes = 0, bites = 0;
    for (const glm::vec3 at : {glm::vec3(0.3f, -0.1f, -3.8f), glm::vec3(2.7f, -0.1f, -2.1f)}) {
        SharkAt one(at);
        int aimed = 0, warned = 0, held = 0;
        for (int i = 0; i < 2600; ++i) {
            const int cycle = i % 260; // the hand is closed for 1.2 s, open for a second
            if (cycle == 0) {
                one.rest();
                one.fish().uncatchable_s = 0;
            }
            const bool before = one.shark.state == Shark::State::Strike;
            one.hand(kPlace, cycle < 144 ? 1.0f : 0.0f);
            if (!before && one.shark.state == Shark::State::Strike) {
                ++strikes;
                EXPECT_GE(aimed, 84) << "ticks, at tick " << i;
            }
            if (one.shark.mouth >= 0 && held > 0) {
                ++bites;
                EXPECT_GE(warned, 143) << "ticks, at tick " << i;
                EXPECT_GE(held, 59) << "ticks, at tick " << i;
            }
            warned = one.shark.aims() ? warned + 1 : 0;
            held = one.held() >= 0 ? held + 1 : 0;
            aimed = one.shark.state == Shark::State::Threaten && one.pointsAtHand() ? aimed + 1 : 0;
        }
    }
    EXPECT_GE(strikes, 2);
    EXPECT_GE(bites, 1);
}

// A fish that has become a catch during the strike is no prey any more.
TEST(SharkRules, GivesUpAStrikeAtACatch) {
    SharkAt one({0, -0.1f, -3.2f});
    one.takeFish();
    one.shark.set(Shark::State::Strike);
    one.shark.prey = 0;
    one.fish().hold.counted = true;
    one.step();
    EXPECT_EQ(one.shark.state, Shark::State::Prowl);
    EXPECT_EQ(one.shark.prey, -1);
}

TEST(SharkRules, ABumpDropsWhatTheHandHolds) {
    OneFish one({.shark = true});
    one.takeFish();
    // Its flank comes upon the hand while it is after nothing.
    one.world.shark.position = kPlace + glm::vec3(0.25f, 0, -0.1f);
    one.world.shark.forward = {0, 0, -1};
    one.world.shark.set(Shark::State::Leave);
    one.step();
    EXPECT_EQ(count<EventKind::SharkBump>(one.events), 1);
    EXPECT_EQ(count<EventKind::Escape>(one.events), 1);
    EXPECT_EQ(one.held(), -1);
    one.step(60);
    EXPECT_EQ(count<EventKind::SharkBump>(one.events), 1) << "one bump, not one a tick";
}

TEST(SharkRules, VisitsAreAnnouncedAndNoneBeginsAfterTheDive) {
    OneFish one({.shark = true,
                 .change = [](DiveFile& file) { file.shark.visits_s.push_back(file.duration_s + 1); }});
    one.step(95 * 120);
    const std::vector<float>& visits_s = one.world.file().shark.visits_s;
    EXPECT_EQ(count<EventKind::SharkNear>(one.events), static_cast<int>(visits_s.size()) - 1);
    const Event* near = first<EventKind::SharkNear>(one.events);
    ASSERT_NE(near, nullptr);
    EXPECT_EQ(near->creature, 1);
    EXPECT_NEAR(static_cast<float>(one.tickOfFirst<EventKind::SharkNear>()) / 120, visits_s[0], 0.02f);
}

} // namespace
} // namespace shoal::game
