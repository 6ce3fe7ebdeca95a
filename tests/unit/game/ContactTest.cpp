// Physics of hands among fish, in the cases in which it is most likely to fail. RulesTest has the rules.
#include "Fixture.h"

namespace shoal::game {
namespace {

bool finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Everything that must hold of every fish at every tick. Returns the fastest free one.
float checkAll(const OpenDive& world, const char* where) {
    float fastest = 0;
    for (const Fish& f : world.fish) {
        EXPECT_TRUE(finite(f.position) && finite(f.velocity) && finite(f.forward)) << where;
        EXPECT_NEAR(glm::length(f.worldFromBody), 1, 1e-3f) << where;
        if (f.heldBy < 0 && f.state != Fish::State::Mouth)
            fastest = std::max(fastest, glm::length(f.velocity));
    }
    EXPECT_LE(fastest, kMaxSpeed_mps + 1e-3f) << where;
    return fastest;
}

glm::vec3 somewhere(Random& random, float maximum) {
    return {random.between(-maximum, maximum), random.between(-maximum, maximum),
            random.between(-maximum, maximum)};
}

TEST(Contact, AFastHandNeitherMissesNorFlingsAFish) {
    for (float speed : {5.0f, 20.0f, 60.0f})
        for (int axis = 0; axis < 3; ++axis)
            for (float offset : {0.2f, 0.5f, 0.8f}) {
                const std::string name = std::to_string(speed) + " m/s, axis " + std::to_string(axis) +
                                         ", offset " + std::to_string(offset);
                OneFish one;
                glm::vec3 way(0);
                way[axis] = speed / 120;
                one.fish().position = kPlace + glm::vec3(0, 2, 0);
                one.hand(kPlace - way * offset, 1);
                one.rest();
                one.events.clear();
                for (int i = 0; i < 60; ++i) { // through the fish in a tick, on for seven more, and a rest
                    const glm::vec3 was = one.fish().position;
                    one.hand(kPlace + way * (1 - offset + static_cast<float>(std::min(i, 7))), 1);
                    checkAll(one.world, name.c_str());
                    // Position and velocity agree, up to rounding.
                    EXPECT_LE(glm::distance(was, one.fish().position) * 120, kMaxSpeed_mps + 1e-3f) << name;
                    if (i > 0) continue;
                    EXPECT_GE(count<EventKind::Touch>(one.events), 1) << name;
                    if (axis > 0) continue;
                    EXPECT_EQ(count<EventKind::Startle>(one.events), 1) << name;
                    EXPECT_GT(glm::length(one.fish().push), 0.2f) << name;
                }
            }
}

// The hands close in from both sides, faster than the fish could part from either, and stay.
TEST(Contact, AFishPressedBetweenTwoHandsStaysBetweenThem) {
    OneFish one;
    const auto hands = [&](float apart) {
        one.input.hands[0] = handAt(kPlace + glm::vec3(-apart, 0, 0), 0, 0);
        one.input.hands[1] = handAt(kPlace + glm::vec3(apart, 0, 0), 0, 1);
    };
    hands(0.2f);
    one.step();
    one.rest();
    float fastest = 0;
    glm::vec3 was = one.fish().velocity;
    int reversals = 0;
    for (int i = 0; i < 240; ++i) {
        hands(std::max(0.03f, 0.2f - 0.003f * static_cast<float>(i)));
        one.step();
        fastest = std::max(fastest, checkAll(one.world, "pressed"));
        if (one.fish().heldBy < 0 && glm::dot(was, one.fish().velocity) < -0.04f) ++reversals;
        was = one.fish().velocity;
    }
    EXPECT_LT(fastest, 2.2f) << "it may flee, it is not shot out";
    EXPECT_LT(reversals, 12) << "it does not rattle between them";
}

// Two flat palms facing one another hold a fish without any fist: contacts oppose each other around it.
TEST(Contact, TwoPalmsHoldAFishBetweenThem) {
    OneFish one;
    const auto palms = [&](float apart) {
        for (int side = 0; side < 2; ++side) {
            hands::HandShape flat;
            hands::JointPose wrist;
            // Fingers ahead, palms towards each other: the right hand's -Y points to the left.
            const float roll = side == 1 ? -1.0f : 1.0f;
            wrist.orientation = glm::angleAxis(roll * 1.5707963f, glm::vec3(0, 0, 1));
            wrist.position = kPlace + glm::vec3((side == 1 ? 1 : -1) * apart, 0, 0.09f);
            one.input.hands[side] =
                rig().pose(side == 0 ? hands::Side::Left : hands::Side::Right, flat, wrist);
        }
    };
    palms(0.2f);
    one.step();
    one.rest();
    one.fish().forward = {0, 0, -1};
    bool held = false;
    for (int i = 0; i < 160 && !held; ++i) {
        palms(std::max(0.028f, 0.2f - 0.002f * static_cast<float>(i)));
        if (one.fish().heldBy < 0) one.fish().forward = {0, 0, -1};
        if (i < 80) one.rest();
        one.step();
        held = one.fish().heldBy >= 0;
        checkAll(one.world, "palms");
    }
    EXPECT_TRUE(held);
}

TEST(Contact, FortyFishInOneFistAreOneCatchAndNoExplosion) {
    OpenDive world(cove().species,
                   OneFish::lonely({.change = [](DiveFile& file) { file.schools[0].count = 40; }}), 5);
    world.input.hands[1] = handAt(kPlace);
    world.step();
    Random random(11, 1);
    for (Fish& f : world.fish) {
        f.position = kPlace + somewhere(random, 0.03f);
        f.velocity = f.push = glm::vec3(0);
        f.speed = 0;
    }
    for (int i = 1; i <= 240; ++i) {
        world.input.hands[1] = handAt(kPlace, std::min(1.0f, static_cast<float>(i) / 15));
        world.step();
        checkAll(world, "forty");
        int held = 0;
        for (const Fish& f : world.fish) held += f.heldBy >= 0;
        ASSERT_LE(held, 1);
    }
    EXPECT_EQ(count<EventKind::Grab>(world.events), 1);
    EXPECT_EQ(world.score.caught, 1);
    // The others have left the fist.
    int inside = 0;
    for (const Fish& f : world.fish) inside += glm::distance(f.position, kPlace) < 0.06f;
    EXPECT_LE(inside, 4);
}

TEST(Contact, AFistClosedOnAnEmptyPlaceCatchesNothingThatSwimsIn) {
    for (float closed : {0.6f, 0.8f, 1.0f})
        for (int from = 0; from < 6; ++from) {
            OneFish one;
            one.rest(kPlace + glm::vec3(0, 2, 0));
            one.moveGrip(kPlace, 0, closed);
            one.rest(kPlace + glm::vec3(0, 2, 0));
            one.step(60);
            one.events.clear();
            glm::vec3 side(0);
            side[from / 2] = from % 2 ? 0.15f : -0.15f;
            for (int i = 0; i < 180; ++i) { // again and again, at 0.5 m/s
                if (i % 60 == 0) one.rest(kPlace + side);
                one.fish().forward = -glm::normalize(side);
                one.fish().speed = 0.5f;
                one.step();
                checkAll(one.world, "swims in");
            }
            EXPECT_EQ(count<EventKind::Grab>(one.events), 0) << closed << " from side " << from;
        }
}

// A camera sees a hand at 30 Hz: it rests for three ticks and goes four ticks' way in one. It pushes as the
// same hand at 120 Hz does, not four times as hard.
TEST(Contact, AHandThatComesAt30HzPushesAsOneAt120Hz) {
    const auto fastestPushed = [](int every) {
        OneFish one;
        const glm::vec3 start = kPlace + glm::vec3(-0.25f, 0, 0);
        one.hand(start, 1);
        one.rest();
        float fastest = 0;
        for (int i = 1; i <= 90; ++i) { // 0.6 m/s
            if (i % every == 0)
                one.input.hands[1] = handAt(start + glm::vec3(0.6f * static_cast<float>(i) / 120, 0, 0), 1);
            one.fish().speed = 0;
            one.fish().state = Fish::State::Cruise;
            one.fish().flight.rest_s = 1; // pushed, not fleeing
            one.step();
            fastest = std::max(fastest, glm::length(one.fish().push));
        }
        return fastest;
    };
    const float smooth = fastestPushed(1), coarse = fastestPushed(4);
    EXPECT_GT(smooth, 0.4f);
    EXPECT_LT(smooth, 0.9f);
    // The smoothing over 25 ms leaves a ripple of a half of the hand's speed.
    EXPECT_NEAR(coarse, smooth, 0.5f * 0.6f + 0.1f);
}

TEST(Contact, BothHandsInTheSamePlaceShareNothingAndBreakNothing) {
    OneFish one;
    one.input.hands = {handAt(kPlace, 0, 0), handAt(kPlace, 0, 1)};
    one.step();
    one.rest();
    for (int i = 1; i <= 200; ++i) {
        const float closed = std::min(1.0f, static_cast<float>(i) / 15);
        one.input.hands = {handAt(kPlace, closed, 0), handAt(kPlace, closed, 1)};
        one.step();
        checkAll(one.world, "same place");
        EXPECT_FALSE(one.world.hands[0].grasp.holds == 0 && one.world.hands[1].grasp.holds == 0);
    }
    EXPECT_GE(count<EventKind::Grab>(one.events), 1);
    EXPECT_EQ(one.world.score.caught, 1);
}

// A hand that glides back to where tracking found it again goes through fish as if it were not there.
TEST(Contact, AHandThatIsNotSolidTouchesNothing) {
    OneFish gliding, without;
    const glm::vec3 start = kPlace + glm::vec3(-0.3f, 0, 0);
    gliding.input.hands[1] = handAt(start);
    gliding.input.hands[1].solid = false;
    gliding.step(2);
    gliding.rest();
    gliding.events.clear();
    for (int i = 1; i <= 60; ++i) { // 1.2 m/s, closing on the way
        gliding.input.hands[1] =
            handAt(start + glm::vec3(0.01f * static_cast<float>(i), 0, 0), static_cast<float>(i) / 60);
        gliding.input.hands[1].solid = false;
        gliding.step();
        EXPECT_EQ(gliding.fish().push, glm::vec3(0));
        EXPECT_EQ(gliding.fish().separation, glm::vec3(0));
    }
    EXPECT_TRUE(gliding.events.empty()) << rowOf(gliding.events[0].kind).name;
    EXPECT_EQ(gliding.fish().heldBy, -1);
    EXPECT_EQ(gliding.fish().state, Fish::State::Cruise);
}

// A hand becomes solid in the middle of a fish: it pushes the fish out gently, without the glide's speed.
TEST(Contact, AHandThatBecomesSolidInsideAFishLetsItOutGently) {
    OneFish one;
    one.input.hands[1] = handAt(kPlace + glm::vec3(-0.3f, 0, 0), 1);
    one.input.hands[1].solid = false;
    one.step(2);
    one.rest();
    one.input.hands[1] = handAt(kPlace, 1); // 36 m/s
    one.input.hands[1].solid = false;
    one.step();
    one.rest();
    one.input.hands[1].solid = true;
    for (int i = 0; i < 120; ++i) {
        one.fish().speed = 0;
        one.fish().flight.rest_s = 1;
        one.fish().state = Fish::State::Cruise;
        const glm::vec3 was = one.fish().position;
        one.step();
        // Its own speed and the parting; a fish at rest turns and starts at 3 m/s2 at most.
        EXPECT_LE(glm::distance(was, one.fish().position) * 120, 1.1f * physics::kPartMax_mps + 0.1f) << i;
    }
    EXPECT_EQ(count<EventKind::Grab>(one.events), 0);
}

TEST(Contact, ALooseGripLosesABigFishAndAFirmOneKeepsIt) {
    const auto heldFor = [](float closed) {
        OneFish one;
        one.fish().species = findSpecies(one.world.species(), "snapper");
        one.closeOn(closed);
        int ticks = 0;
        for (int i = 0; i < 110; ++i) {
            ticks += one.fish().heldBy >= 0;
            one.step();
        }
        return ticks;
    };
    EXPECT_GT(heldFor(1), 100);
    EXPECT_LT(heldFor(0.45f), 60);
}

// The struggle makes it slip: the same grip that holds a quiet fish gives when it is waved about.
TEST(Contact, AFishIsTornFromAHandThatGoesTooFast) {
    const auto caughtAt = [](float speed) {
        OneFish one;
        one.fish().species = findSpecies(one.world.species(), "snapper");
        one.takeFish();
        for (int i = 0; i < 40 && one.held() == 0; ++i) {
            const float eased = std::min(1.0f, static_cast<float>(i) / 20); // share of the speed
            one.hand(kPlace + glm::vec3(0, 0.5f * eased * speed * static_cast<float>(i) / 120, 0), 1);
            checkAll(one.world, "torn");
        }
        return one.held() == 0;
    };
    EXPECT_TRUE(caughtAt(0.5f));
    EXPECT_FALSE(caughtAt(10.0f));
}

// Fingers tremble by 2 mm about the grip that just holds, and its strength between the two thresholds: one
// grab, and no flutter of grab and escape.
TEST(Contact, ATremblingGripHasHysteresis) {
    OneFish one;
    Random random(23, 1);
    one.takeFish(0.7f);
    for (int i = 0; i < 100; ++i) {
        one.input.hands[1] = handAt(kPlace, 0.7f);
        one.input.hands[1].grip = i % 2 ? kGripOpens + 0.02f : kGripCloses + 0.02f;
        for (hands::Joint& joint : one.input.hands[1].joints) joint.position += somewhere(random, 0.002f);
        one.step();
    }
    EXPECT_EQ(count<EventKind::Grab>(one.events), 1);
    EXPECT_EQ(count<EventKind::Escape>(one.events), 0);
}

TEST(Contact, FingersRestOnAHeldFishAndDoNotEnterIt) {
    OneFish one;
    one.takeFish();
    one.step(40);
    const Snapshot now = one.shown();
    const physics::Capsule flesh = capsuleOf(one.fish(), one.world.species()[one.fish().species]);
    const auto& shown = now.hands[1].joints;
    const auto& given = one.world.hands[1].joints;
    float deepestShown = 0, deepestGiven = 0;
    for (int j = 7; j < hands::kJointCount; ++j) {
        if ((j - 6) % 5 < 2) continue; // a bone of the palm
        const auto depth = [&](const auto& joints) {
            const hands::Joint &a = joints[hands::kJointParent[j]], &b = joints[j];
            return -physics::separation({a.position, b.position, std::min(a.radius, b.radius)}, flesh);
        };
        deepestShown = std::max(deepestShown, depth(shown));
        deepestGiven = std::max(deepestGiven, depth(given));
    }
    EXPECT_GT(deepestGiven, 0.01f) << "a bare fist would go through it";
    EXPECT_LT(deepestShown, 0.006f) << "the ease lags behind its wriggle by some millimetres";
    // Each finger that touches the fish feels it, and its struggle.
    int touching = 0;
    for (const TouchView& touch : now.hands[1].touching)
        if (touch.touches) {
            ++touching;
            EXPECT_GT(touch.struggle, 0);
        }
    EXPECT_GE(touching, 3);
}

TEST(Contact, NoFingerJumpsWhenAFistLosesItsFish) {
    OneFish one;
    one.takeFish();
    one.step(30);
    auto before = one.world.hands[1].fingers.shown;
    float farthest = 0, lifted = 0;
    for (int i = 0; i < 240; ++i) { // the catch, the letting go, and an empty fist
        one.step();
        const auto& now = one.world.hands[1].fingers.shown;
        for (int j = 0; j < hands::kJointCount; ++j) {
            farthest = std::max(farthest, glm::distance(now[j].position, before[j].position));
            lifted =
                std::max(lifted, glm::distance(before[j].position, one.world.hands[1].joints[j].position));
            EXPECT_NEAR(glm::length(now[j].orientation), 1, 1e-3f);
        }
        before = now;
    }
    EXPECT_EQ(one.world.score.caught, 1);
    EXPECT_GT(lifted, 0.02f);
    EXPECT_LE(farthest, physics::kEase * lifted * 1.1f);
    for (int j = 0; j < hands::kJointCount; ++j)
        EXPECT_LT(glm::distance(before[j].position, one.world.hands[1].joints[j].position), 1e-3f);
}

// Ten minutes of two hands thrashing about among all fish: every speed bounded, and what the last minute has
// of kinetic energy is what the second had. Then the hands leave, and the fish calm down to their cruising.
TEST(Contact, EnergyNeverGrowsFromNothingInTenMinutesOfThrashing) {
    DiveFile file = calmCove();
    file.duration_s = 1e6f;
    OpenDive world(cove().species, file, 3);
    const auto energy = [&] {
        double sum = 0;
        for (const Fish& f : world.fish) {
            const Species& kind = world.species()[f.species];
            const double mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
            sum += 0.5 * mass * glm::dot(f.velocity, f.velocity);
        }
        return sum;
    };
    const double calm = energy();
    Random random(29, 1);
    std::array<glm::vec3, 2> at{kPlace, kPlace}, goal{kPlace, kPlace};
    std::array<float, 10> minutes{};
    for (int tick = 0; tick < 10 * 60 * 120; ++tick) {
        for (int h = 0; h < 2; ++h) {
            if (tick % 40 == 20 * h) goal[h] = somewhere(random, 1.1f) * glm::vec3(1, 0.5f, 1);
            at[h] += (goal[h] - at[h]) * 0.15f; // up to 20 m/s
            const float closed = (tick / (h ? 90 : 130)) % 2 ? 1.0f : 0.0f;
            world.input.hands[h] = handAt(at[h], closed, h);
        }
        world.events.clear();
        world.step();
        if (tick % 4 == 0) checkAll(world, "thrashing");
        minutes[tick / 7200] += static_cast<float>(energy() / 7200);
    }
    EXPECT_LT(*std::max_element(minutes.begin() + 2, minutes.end()), 2 * minutes[1]);
    world.input.hands[0].tracked = world.input.hands[1].tracked = false;
    world.run(8);
    EXPECT_LT(energy(), 2 * calm);
}

} // namespace
} // namespace shoal::game
