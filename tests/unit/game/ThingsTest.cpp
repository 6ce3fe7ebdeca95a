// Loose things: picked up, cracked, kept, thrown, and what they do to fish and shark.
#include "game/rules/Things.h"
#include "game/rules/SharkBehaviour.h"
#include "tests/unit/game/Fixture.h"

namespace shoal::game {
namespace {

const DiveFiles& bay() {
    static const DiveFiles files =
        tests::valueOf(loadDiveFiles((dataRoot() / "tests/playthrough/dive/bay.toml").string()));
    return files;
}

int speciesOf(const char* name) { return findSpecies(bay().species, name); }

// A dive with one thing 0.6 m ahead (id 0) and, if wanted, one clownfish (id 1) and the shark.
struct OneThing : OneFish {
    static Setting only(const char* name, bool shark, bool fish, DiveRules rules) {
        return {shark, rules, [name, fish](DiveFile& file) {
                    School thing = file.schools[0];
                    thing.species = speciesOf(name);
                    if (!fish) file.schools.clear();
                    file.schools.insert(file.schools.begin(), thing);
                }};
    }
    explicit OneThing(const char* name, bool shark = false, bool fish = false, DiveRules rules = {})
        : OneFish(only(name, shark, fish, rules)) {
        place(kPlace);
    }
    void place(glm::vec3 at, glm::vec3 velocity = glm::vec3(0)) {
        Fish& f = fish();
        f.position = f.loose.home = at;
        f.push = f.velocity = velocity;
        if (velocity != glm::vec3(0)) f.state = Fish::State::Loose;
    }
    void throwAt(glm::vec3 from, glm::vec3 velocity) {
        place(from, velocity);
        fish().loose.thrown = true;
        fish().gait.set(Motion::Detached);
    }
    // Puts the shark at a place, in a state, looking along +Z towards the viewer.
    void putShark(glm::vec3 at, Shark::State state) {
        Shark& shark = world.shark;
        shark.position = at;
        shark.forward = {0, 0, 1};
        shark.worldFromBody = glm::quat(1, 0, 0, 0);
        shark.velocity = glm::vec3(0);
        shark.speed = 0;
        shark.visit_s = 10;
        shark.set(state);
    }
    void run(float seconds) { step(static_cast<int>(seconds * 120)); }
    void take() {
        moveGrip(kPlace, 0, 0);
        moveGrip(kPlace, 0, 1);
        ASSERT_EQ(held(), 0);
    }
};

TEST(Things, DriftWhereTheyAreUntilAHandTakesThem) {
    OneThing one("stone");
    one.step(240);
    EXPECT_EQ(one.fish().state, Fish::State::Drift);
    EXPECT_LT(glm::distance(one.fish().position, kPlace), 0.001f);
    EXPECT_EQ(one.shown().creatures[0].gait.motion, Motion::Drift);
    one.take();
    EXPECT_EQ(one.shown().creatures[0].gait.motion, Motion::Detached);
    EXPECT_EQ(one.shown().hands[1].holdProgress, 0);
    for (int i = 0; i < 600; ++i) one.hand(kPlace, 1); // a stone is kept for as long as the hand is closed
    EXPECT_EQ(one.held(), 0);
    one.moveGrip(kPlace, 1, 0);
    EXPECT_EQ(one.held(), -1);
    EXPECT_EQ(count<EventKind::Release>(one.events), 1);
    EXPECT_EQ(count<EventKind::Throw>(one.events), 0);
    for (int i = 0; i < 480; ++i) one.hand({0.3f, 0.2f, -0.4f});
    const float floor_m = one.world.file().floor_m + one.world.species()[one.fish().species].bodyRadius_m;
    EXPECT_NEAR(one.fish().position.y, floor_m, 0.003f); // it lies on the floor
    EXPECT_LT(glm::length(one.fish().velocity), 0.05f);
}

TEST(Things, LieOnTheFloorOfThePlayersOwnRoom) {
    OneThing one("stone", false, false, {.seated = true, .roomFloor_cm = 130});
    one.place(kPlace, {0, -0.1f, 0});
    one.run(6);
    EXPECT_NEAR(one.fish().position.y, -1.3f + one.world.species()[one.fish().species].bodyRadius_m, 0.003f);
}

TEST(Things, AThrowHasTheMeanVelocityOfTheLastTicks) {
    OneThing one("stone", false, false, {.assist = Assist::None});
    one.take();
    glm::vec3 at = kPlace;
    for (int i = 0; i < 30 && one.held() == 0; ++i) { // 2.4 m/s to the left, opening at the end
        at.x -= 0.02f;
        one.hand(at, i < 15 ? 1.0f : 1 - static_cast<float>(i - 14) / 6);
    }
    ASSERT_EQ(one.held(), -1);
    ASSERT_EQ(count<EventKind::Throw>(one.events), 1);
    // The hand's filter and the water take some of it.
    EXPECT_NEAR(one.fish().push.x, -2.4f, 0.15f);
    EXPECT_NEAR(one.fish().push.z, 0, 0.1f);
}

TEST(Things, AMusselCracksInHalfASecondAndFishLoseTheirFear) {
    OneThing one("mussel", false, true);
    Fish& fish = one.world.fish[1];
    fish.position = {0.5f, 0, -1.2f};
    one.take();
    for (int i = 0; i < 75; ++i) one.hand(kPlace, 1);
    ASSERT_EQ(count<EventKind::Crack>(one.events), 1);
    EXPECT_EQ(one.shown().creatures[0].gait.motion, Motion::Open);
    for (int i = 0; i < 600 && count<EventKind::Feed>(one.events) == 0; ++i) one.hand(kPlace, 0);
    EXPECT_EQ(count<EventKind::Feed>(one.events), 1);
    EXPECT_LT(glm::distance(fish.position, one.world.hands[1].graspCentre), 0.25f);
    EXPECT_EQ(count<EventKind::NoGuest>(one.events), 0);
    EXPECT_EQ(count<EventKind::Catch>(one.events), 0);
    // A hand that would frighten it (3 m/s) does not while it feeds.
    one.hand(kPlace + glm::vec3(0, 0, 0.05f));
    EXPECT_EQ(fish.state, Fish::State::Cruise);
    // The spent mussel is not taken again.
    EXPECT_FALSE(one.world.context().mayBeTaken(one.fish()));
}

TEST(Things, ABottleComesUpAndCountsPointsOutsideOfRuns) {
    OneThing one("bottle", false, true);
    EXPECT_EQ(one.fish().state, Fish::State::Gone);
    EXPECT_TRUE(one.shown().creatures[0].hidden);
    one.fish().loose.time_s = 0.1f;
    one.run(0.8f);
    ASSERT_EQ(one.fish().state, Fish::State::Loose);
    EXPECT_GT(one.fish().velocity.y, 0.05f);
    one.place(kPlace, {0, 0.1f, 0});
    one.take();
    for (int i = 0; i < 130; ++i) one.hand(kPlace, 1);
    ASSERT_EQ(count<EventKind::Collect>(one.events), 1);
    EXPECT_EQ(first<EventKind::Collect>(one.events)->points, 30);
    EXPECT_EQ(one.fish().state, Fish::State::Gone);
    EXPECT_EQ(one.held(), -1);
    EXPECT_EQ(one.world.score.points, 30);
    EXPECT_EQ(one.world.score.caught, 0);
    EXPECT_EQ(one.world.score.combo(), 0);
    EXPECT_EQ(progressOf({GoalKind::Catch, speciesOf("bottle"), 2}, one.world.score), 1);
    EXPECT_EQ(progressOf({GoalKind::Different, -1, 2}, one.world.score), 0);
    one.run(60);
    EXPECT_EQ(one.fish().state, Fish::State::Gone); // it never comes back
}

TEST(Things, AStoneFrightensFishThatItPasses) {
    for (const float speed : {0.3f, 4.0f}) {
        OneThing one("stone", false, true);
        Fish& fish = one.world.fish[1];
        fish.position = {0.15f, 0, -1};
        fish.forward = {1, 0, 0};
        one.throwAt({0, 0, -0.8f}, {0, 0, -speed});
        one.step(10);
        EXPECT_EQ(count<EventKind::Startle>(one.events), speed > 1 ? 1 : 0) << speed;
    }
}

TEST(Things, AStoneBeforeItsEyesTurnsAProwlingSharkAway) {
    for (const auto state : {Shark::State::Prowl, Shark::State::Threaten, Shark::State::Circle})
        for (const float aside : {0.0f, 1.0f}) {
            OneThing one("stone", true);
            one.putShark({0, 0, -2.5f}, state);
            one.world.shark.watched = 1;
            one.hand({0.3f, -0.3f, -0.4f});
            const glm::vec3 nose = mouthOf(one.world.shark, one.world.context());
            one.throwAt(nose + glm::vec3(aside - 0.25f, 0.1f, 0.1f), {3, 0, 0});
            one.step(8);
            const bool turns = aside == 0 && state != Shark::State::Circle;
            EXPECT_EQ(count<EventKind::SharkTurns>(one.events), turns) << aside;
            EXPECT_EQ(one.world.shark.state == Shark::State::Leave, turns);
        }
}

TEST(Things, AStoneOnTheSnoutSavesAFishFromAStrike) {
    for (const bool struck : {false, true}) {
        OneThing one("stone", true, true);
        Fish& fish = one.world.fish[1];
        one.moveGrip(kPlace, 0, 0);
        fish.position = kPlace;
        fish.state = Fish::State::Held;
        fish.heldBy = 1;
        one.world.hands[1].grasp.holds = 1;
        one.putShark({0, -0.1f, -2.3f}, Shark::State::Strike);
        one.world.shark.prey = 1;
        const glm::vec3 nose = mouthOf(one.world.shark, one.world.context());
        one.throwAt(nose + glm::vec3(struck ? 0 : 0.35f, 0, 0.12f), {0, 0, -6});
        for (int i = 0; i < 6; ++i) one.hand(kPlace, 1);
        EXPECT_EQ(count<EventKind::SharkTurns>(one.events), struck);
        EXPECT_EQ(one.world.shark.prey, struck ? -1 : 1);
        EXPECT_EQ(fish.state, Fish::State::Held);
        EXPECT_EQ(one.world.score.lost, 0);
    }
}

// With help, a throw 12 degrees beside the shark's head strikes it; without, it goes where the hand went.
TEST(Things, HelpAimsAStoneAtTheShark) {
    for (const Assist assist : {Assist::None, Assist::Normal, Assist::Strong}) {
        OneThing one("stone", true, false, {.assist = assist});
        one.putShark({0.1f, 0.3f, -2.6f}, Shark::State::Circle);
        one.take();
        Hand& hand = one.world.hands[1];
        for (size_t i = 0; i < hand.trail.size(); ++i)
            hand.trail[i] = hand.palm().position + glm::vec3(0, 0, 0.025f * static_cast<float>(i));
        hand.grip = 0;
        letGo(one.fish(), 0, hand, 1, one.world.context(), one.events);
        const glm::vec3 thrown = one.fish().push;
        if (assist == Assist::None) {
            EXPECT_NEAR(glm::distance(thrown, glm::vec3(0, 0, -3)), 0, 1e-3f);
            continue;
        }
        EXPECT_GT(glm::length(thrown), 3.9f);
        float nearest = 9;
        const glm::vec3 nose = mouthOf(one.world.shark, one.world.context());
        physics::LooseBody stone{.radius = 0.025f,
                                 .half = 0.0165f,
                                 .density_kgpm3 = 2650,
                                 .drag = 0.25f,
                                 .position = one.fish().position,
                                 .velocity = thrown};
        for (int i = 0; i < 60; ++i) {
            stone.velocity = physics::inWater(stone, kDt);
            stone.position += stone.velocity * kDt;
            nearest = std::min(nearest, glm::distance(stone.position, nose));
        }
        EXPECT_LT(nearest, 0.2f); // the aim is at 0.4 of the length ahead of the middle, the mouth at 0.46
    }
}

TEST(Things, DriftAgainOnceTheyHaveLainUnseenForAWhile) {
    OneThing one("stone");
    one.place({0, -1, 0.8f}, {0, -0.1f, 0}); // behind the back
    one.fish().loose.home = {0.2f, -0.2f, 0.7f};
    one.run(11);
    EXPECT_EQ(one.fish().state, Fish::State::Loose);
    one.run(2);
    EXPECT_EQ(one.fish().state, Fish::State::Drift);
    EXPECT_LT(glm::distance(one.fish().position, glm::vec3(0.2f, -0.2f, 0.7f)), 0.01f);
    OneThing seen("stone");
    seen.place({0, -0.4f, -0.8f}, {0, -0.1f, 0});
    seen.run(15);
    EXPECT_EQ(seen.fish().state, Fish::State::Loose);
}

TEST(Things, AMusselThatComesBackIsWholeAndLevel) {
    OneThing one("mussel");
    one.take();
    for (int i = 0; i < 75; ++i) one.hand(kPlace, 1);
    ASSERT_TRUE(one.fish().loose.spent);
    one.moveGrip(kPlace, 1, 0);
    ASSERT_EQ(one.fish().state, Fish::State::Loose);
    one.fish().position = {0, -1, 0.8f};
    one.fish().loose.home = {0, -0.2f, 0.7f}; // both behind the back
    one.run(14);
    EXPECT_EQ(one.fish().state, Fish::State::Drift);
    EXPECT_TRUE(one.world.context().mayBeTaken(one.fish()));
    EXPECT_NEAR((one.fish().worldFromBody * kUp).y, 1, 1e-5f);
    EXPECT_EQ(one.shown().creatures[0].gait.motion, Motion::Drift);
}

// A film of level sand 0.9 m below the camera, above the dive's own floor.
TEST(Things, ComeToRestOnTheFilmsSand) {
    DiveFile file = OneThing("stone").world.file();
    file.space = madeSpace(
        4, 8, [](glm::vec3 dir, double) { return dir.y < -0.12f ? -0.9f / dir.y : FilmSpace::kFar_m; });
    OpenDive dive(bay().species, file, 5, {});
    Fish& stone = dive.fish[0];
    stone.position = {0.1f, -0.3f, -0.7f};
    stone.state = Fish::State::Loose;
    stone.loose.thrown = true;
    dive.run(4);
    EXPECT_NEAR(stone.position.y, -0.9f + 0.025f, 0.02f);
    EXPECT_LT(glm::length(stone.velocity), 0.1f);
    EXPECT_LT(glm::length(stone.push), 0.1f);
    EXPECT_FALSE(stone.loose.thrown);
    EXPECT_GE(count<EventKind::Knock>(dive.events), 1);
}

TEST(Things, TheEndOfTheDiveThrowsNothing) {
    OneThing one("stone");
    one.take();
    one.world.state().tick = static_cast<uint32_t>(one.world.file().duration_s * 120) - 20;
    glm::vec3 at = kPlace;
    for (int i = 0; i < 30; ++i) one.hand(at += glm::vec3(0.01f, 0, 0), 1);
    EXPECT_EQ(count<EventKind::DiveOver>(one.events), 1);
    EXPECT_EQ(count<EventKind::Throw>(one.events), 0);
    EXPECT_EQ(count<EventKind::Release>(one.events), 1);
}

// A film whose surfaces are all 1.5 m away.
TEST(Things, ComeBackFromTheFilmsRock) {
    for (const glm::vec3 way :
         {glm::vec3(0, 0, -1), glm::vec3(0.6f, 0.64f, 0.48f), glm::vec3(-0.8f, 0.6f, 0)}) {
        DiveFile file = OneThing("stone").world.file();
        file.space = madeSpace(4, 8, [](glm::vec3, double) { return 1.5f; });
        OpenDive dive(bay().species, file, 5, {});
        Fish& stone = dive.fish[0];
        stone.position = 0.9f * way;
        stone.push = 6.0f * way;
        stone.state = Fish::State::Loose;
        float most = 0, back = 0;
        for (int i = 0; i < 60; ++i) {
            dive.step();
            most = std::max(most, glm::length(stone.position));
            back = std::min(back, glm::dot(stone.push, way));
        }
        EXPECT_LE(most, 1.5f);
        EXPECT_LT(back, -0.3f);
        EXPECT_GE(count<EventKind::Knock>(dive.events), 1);
    }
}

// Whatever the direction, a box on the surface meets the triangle that the ray through its middle crosses.
TEST(Things, FindTheFilmsSurfaceInEveryDirection) {
    Random random(3, 1);
    std::vector<uint16_t> surface(2 * FilmSpace::kCells);
    for (uint16_t& mm : surface) mm = static_cast<uint16_t>(1500 + random.below(20));
    const FilmSpace space(1, surface);
    const FilmMoment now(&space, 0.25);
    for (int i = 0; i < 3000; ++i) {
        const float x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
        const glm::vec3 way = glm::normalize(glm::vec3(x, y, i % 7 ? z : 0.001f * z)), at = 1.51f * way;
        bool crossed = false;
        now.triangles(at - 0.05f, at + 0.05f, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
            const glm::vec3 sides(glm::dot(glm::cross(a, b), way), glm::dot(glm::cross(b, c), way),
                                  glm::dot(glm::cross(c, a), way));
            constexpr float kEdge = 1e-5f; // of a cell's 0.01 m2
            crossed = crossed || glm::all(glm::greaterThan(sides, glm::vec3(-kEdge))) ||
                      glm::all(glm::lessThan(sides, glm::vec3(kEdge)));
        });
        EXPECT_TRUE(crossed) << way.x << ' ' << way.y << ' ' << way.z;
    }
}

} // namespace
} // namespace shoal::game
