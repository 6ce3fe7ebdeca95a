// How fish and shark swim: their bodies, whole dives, shoals, and visits to a hand that rests.
#include "Fixture.h"

namespace shoal::game {
namespace {

// A beat carries a body on by its stride at any speed (Bainbridge 1958); some kinds glide between beats.
TEST(Tail, BeatsOnceForEachStrideAndRestsWhileItsKindGlides) {
    OpenDive world(cove().species, calmCove(), 6);
    std::vector<double> swum_m(world.fish.size(), 0);
    std::vector<int> gliding(world.fish.size(), 0);
    for (int i = 0; i < 30 * 120; ++i) {
        world.step();
        for (size_t f = 0; f < world.fish.size(); ++f) {
            swum_m[f] += static_cast<double>(world.fish[f].speed) * kDt;
            gliding[f] += world.fish[f].route.gliding && world.fish[f].shape.amplitude < 0.02f;
        }
    }
    for (size_t f = 0; f < world.fish.size(); ++f) {
        const Species& kind = world.species()[world.fish[f].species];
        const double strides = swum_m[f] / static_cast<double>(kind.stride * kind.length_m);
        // 3600 additions to a float of up to 200: each rounds by 2^-17 at most, 0.03 in all.
        EXPECT_NEAR(static_cast<double>(world.fish[f].shape.beats), strides, 0.05) << kind.name;
        if (kind.coasts)
            EXPECT_GT(gliding[f], 120) << kind.name;
        else
            EXPECT_EQ(gliding[f], 0) << kind.name;
    }
}

TEST(Tail, SwingsWiderTheFasterItSwimsUpToATenthOfTheLength) {
    float before = 0;
    for (float pace : {0.1f, 0.5f, 1.0f, 2.0f, 5.0f, 50.0f}) {
        EXPECT_GT(tailAmplitude(pace), before);
        before = tailAmplitude(pace);
    }
    EXPECT_EQ(tailAmplitude(0), 0);
    EXPECT_LT(before, kFullBeat);
    EXPECT_GT(before, 0.99f * kFullBeat);
    EXPECT_EQ(tailBeat_Hz(100, 0.1f, 0.65f), kFastestBeat_Hz);
    EXPECT_FLOAT_EQ(tailBeat_Hz(0.65f, 0.5f, 0.65f), 2);
}

// Headings have inertia, bodies lie along their curved ways, and lean into them.
TEST(Turning, IsSmoothAndBendsAndBanksTheBodyInwards) {
    OpenDive world(cove().species, calmCove(), 2);
    std::vector<glm::vec3> forward, turned;
    int inwards = 0, outwards = 0, leaning = 0, upright = 0;
    for (int i = 0; i < 40 * 120; ++i) {
        forward.resize(world.fish.size());
        turned.resize(world.fish.size());
        for (size_t f = 0; f < world.fish.size(); ++f) forward[f] = world.fish[f].forward;
        world.step();
        for (size_t f = 0; f < world.fish.size(); ++f) {
            const Fish& fish = world.fish[f];
            const Species& kind = world.species()[fish.species];
            const glm::vec3 rate = (fish.forward - forward[f]) / kDt;
            ASSERT_LT(glm::length(rate), 1.01f * kind.turn_radps) << kind.name;
            // The limit of turn(), and 4 % for float headings: a difference of two of 1e-7 each over dt^2.
            if (i > 0) {
                ASSERT_LT(glm::length(rate - turned[f]) / kDt, 9 * kind.turn_radps * 1.04f + 10) << i;
            }
            turned[f] = rate;
            const float yaw = glm::dot(rate, leftOf(forward[f]));
            if (std::fabs(yaw) < 0.5f) continue;
            ++(yaw * fish.shape.bendLeft > 0 ? inwards : outwards);
            ++(yaw * fish.bank > 0 ? leaning : upright);
        }
    }
    ASSERT_GT(inwards, 1000);
    EXPECT_GT(inwards, 9 * outwards);
    EXPECT_GT(leaning, 5 * upright);
}

TEST(Facing, FishLookWhereTheyGo) {
    double off = 0, all = 0, sum = 0;
    for (uint64_t seed : {1, 2, 3}) {
        OpenDive world(cove().species, cove().dive, seed); // shark and all
        for (int i = 0; i < 60 * 120; ++i) {
            world.step();
            for (const Fish& fish : world.fish) {
                const float speed = glm::length(fish.velocity);
                if (speed < 0.1f) continue;
                const float facing = glm::dot(fish.forward, fish.velocity) / speed;
                ++all;
                off += facing < 0.94f; // 20 degrees
                sum += static_cast<double>(facing);
            }
        }
    }
    EXPECT_GT(sum / all, 0.995);
    EXPECT_LT(off, 0.005 * all); // fish that others push
}

// Domenici & Blake 1997: the body snaps into a C, turns away, drives off.
TEST(Flight, BeginsWithACThenSpeedsAwayThenCalmsDown) {
    for (const glm::vec3 from : {glm::vec3(0.2f, 0, 0), glm::vec3(0, 0, 0.2f), glm::vec3(0.15f, 0, 0.15f)}) {
        OneFish one;
        one.fish().route.cruise_mps = 0.25f;
        one.fish().speed = 0.25f;
        one.step(12);
        const glm::vec3 threat = one.fish().position + from;
        one.world.startle(0, threat);
        const float dart = one.world.species()[one.fish().species].dart_mps;
        float bend = 0, fastest = 0;
        int atFullSpeed = 0, turnedAway = 0;
        for (int i = 1; i <= 60; ++i) {
            one.step();
            if (i <= 12) bend = std::max(bend, std::fabs(one.fish().shape.bendLeft));
            fastest = std::max(fastest, one.fish().speed);
            if (!turnedAway && glm::dot(one.fish().forward, one.fish().flight.heading) > 0.8f) turnedAway = i;
            if (!atFullSpeed && one.fish().speed > 0.85f * dart) atFullSpeed = i;
        }
        EXPECT_GT(bend, 1.3f);
        EXPECT_GT(turnedAway, 0);
        EXPECT_LT(turnedAway, 30) << "on its way within 0.25 s, even from straight ahead";
        EXPECT_GT(atFullSpeed, 0);
        EXPECT_LT(atFullSpeed, 30) << "at full speed within 0.25 s";
        EXPECT_GT(glm::distance(one.fish().position, threat), 0.5f);
        one.step(4 * 120);
        EXPECT_EQ(one.fish().state, Fish::State::Cruise);
        EXPECT_LT(one.fish().speed, 1.5f * one.fish().route.cruise_mps);
    }
}

TEST(Held, CurlsAwayFromThePalmAndStrugglesInBouts) {
    OneFish one;
    one.takeFish();
    one.step(24); // it lies in the palm
    int bouts = 0, away = 0, ticks = 0;
    bool wild = one.fish().shape.amplitude > 0.08f;
    for (; one.held() == 0 && ticks < 200; ++ticks) {
        one.step();
        const BodyShape& shape = one.fish().shape;
        if (!wild && shape.amplitude > 0.08f) ++bouts;
        if (shape.amplitude > 0.08f || shape.amplitude < 0.05f) wild = shape.amplitude > 0.08f;
        // The side to which both its ends go, against the side of the palm.
        const glm::vec3 ends = one.fish().worldFromBody * glm::vec3(shape.bendLeft, shape.bendUp, 0);
        const glm::vec3 outOfPalm = one.world.hands[1].joints[0].orientation * glm::vec3(0, -1, 0);
        away += glm::dot(ends, outOfPalm) > 0.3f;
    }
    EXPECT_GT(ticks, 60);
    EXPECT_GE(bouts, 1);
    EXPECT_GT(away, 0.8 * ticks);
}

struct Statistics {
    float nearestPair = 10; // least gap between bodies of fish, m
    int touching = 0, pairs = 0;
    float minUpright = 1, fastest = 0;
    int samples = 0, outOfBand = 0;
    float lowest = 10, highest = -10;
    float nearestEyes = 10; // least distance of a fish's axis from the eyes, m
    double inReach = 0;     // mean number of fish 0.4 to 1.2 m away within 45 degrees of ahead
    float sharkNearest = 100, sharkNoseNearest = 100, sharkFastest = 0;
    float largestStep = 0;
};

Statistics swimFor(const DiveFiles& files, uint64_t seed, int seconds) {
    Dive dive(files.species, files.dive, seed);
    Snapshot now, before;
    Events events;
    Statistics s;
    int frames = 0;
    dive.snapshot(before);
    for (int tick = 0; tick < seconds * 120; ++tick) {
        dive.step({}, events);
        dive.snapshot(now);
        for (size_t i = 0; i < now.creatures.size(); ++i)
            if (files.species[now.creatures[i].species].thing == Thing::None)
                s.largestStep = std::max(
                    s.largestStep, glm::distance(now.creatures[i].position, before.creatures[i].position));
        before = now;
        if (tick % 12) continue;
        ++frames;
        for (size_t i = 0; i < now.creatures.size(); ++i) {
            const CreatureView& c = now.creatures[i];
            const Species& kind = files.species[c.species];
            if (kind.thing != Thing::None) continue;
            const float speed = glm::length(c.velocity);
            const glm::vec3 forward = c.worldFromBody * glm::vec3(0, 0, 1);
            s.minUpright = std::min(s.minUpright, (c.worldFromBody * glm::vec3(0, 1, 0)).y);
            if (kind.shark) {
                s.sharkFastest = std::max(s.sharkFastest, speed);
                s.sharkNearest = std::min(s.sharkNearest, glm::length(c.position));
                s.sharkNoseNearest =
                    std::min(s.sharkNoseNearest, glm::length(c.position + forward * (0.46f * c.length)));
                continue;
            }
            s.fastest = std::max(s.fastest, speed);
            const School& school = files.dive.schools[dive.state().fish[i].school];
            const float radius = std::sqrt(c.position.x * c.position.x + c.position.z * c.position.z);
            ++s.samples;
            s.outOfBand += radius < school.radiusLow_m - 0.3f || radius > school.radiusHigh_m + 0.3f ||
                           c.position.y < school.heightLow_m - 0.25f ||
                           c.position.y > school.heightHigh_m + 0.25f;
            s.lowest = std::min(s.lowest, c.position.y);
            s.highest = std::max(s.highest, c.position.y);
            const float half = 0.5f * c.length,
                        along = std::clamp(-glm::dot(c.position, forward), -half, half);
            s.nearestEyes = std::min(s.nearestEyes, glm::length(c.position + forward * along));
            const float distance = glm::length(c.position);
            s.inReach += distance > 0.4f && distance < 1.2f && c.position.z < -0.7f * distance;
            for (size_t j = 0; j < i; ++j) {
                const CreatureView& d = now.creatures[j];
                const Species& other = files.species[d.species];
                const glm::vec3 a = forward * kind.bodyHalf_m;
                const glm::vec3 b = d.worldFromBody * glm::vec3(0, 0, other.bodyHalf_m);
                const float gap = physics::separation({c.position - a, c.position + a, kind.bodyRadius_m},
                                                      {d.position - b, d.position + b, other.bodyRadius_m});
                s.nearestPair = std::min(s.nearestPair, gap);
                ++s.pairs;
                s.touching += gap < 0;
            }
        }
    }
    s.inReach /= frames;
    return s;
}

// Expects what holds of every dive.
void expectSwimWell(const Statistics& s, const DiveFile& dive) {
    EXPECT_LT(s.touching, s.pairs / 5000);
    // Pitch at most asin 0.6 and a lean of tangent 0.7: cos 37 degrees * cos 35 degrees = 0.65.
    EXPECT_GT(s.minUpright, 0.6f);
    EXPECT_LE(s.fastest, kMaxSpeed_mps + 1e-4f);
    EXPECT_GT(s.lowest, dive.floor_m);
    EXPECT_LT(s.highest, 1.3f);
    EXPECT_GT(s.inReach, 1.0) << "there should nearly always be something to catch ahead";
    EXPECT_GT(s.nearestEyes, 0.35f);
    EXPECT_GT(s.sharkNoseNearest, 0.5f);
    EXPECT_LT(s.largestStep, 3.2f / 120) << "nobody jumps";
}

class Swimming : public testing::TestWithParam<uint64_t> {};

TEST_P(Swimming, KeepsApartUprightAndInBounds) {
    const Statistics s = swimFor(cove(), GetParam(), 90);
    expectSwimWell(s, cove().dive);
    // Bodies are capsules thinner than the fish: they may brush now and then, but not lie inside each other.
    EXPECT_LT(s.touching, s.pairs / 10000);
    EXPECT_GT(s.nearestPair, -0.03f);
    // Three visits of the shark drive them off for a while.
    EXPECT_LT(s.outOfBand, s.samples / 12);
    EXPECT_LT(s.sharkNearest, 2.4f) << "it comes close at times";
    EXPECT_LE(s.sharkFastest, 3.2f);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Swimming, testing::Values(1, 2, 3, 99));

// The shipped dive may gain species and schools; all of them must swim well and make a good dive.
TEST(Reef, IsADiveInWhichFishSwimWell) {
    const auto reef = tests::valueOf(loadDiveFiles("reef"));
    EXPECT_EQ(reef.dive.duration_s, 90);
    EXPECT_EQ(reef.dive.video, "video/reef.mp4");
    int fish = 0;
    std::set<int> kinds;
    for (const School& school : reef.dive.schools) {
        fish += school.count;
        kinds.insert(school.species);
    }
    EXPECT_GE(fish, 24);
    EXPECT_GE(kinds.size(), 3u);
    EXPECT_GE(reef.dive.shark.species, 0);
    EXPECT_THAT(reef.dive.enclosure, testing::Contains(testing::Field(&VideoMark::amount, 1)))
        << "a tunnel, else its bed is never heard";
    expectSwimWell(swimFor(reef, 1, 90), reef.dive);
}

// Shoals, pairs and solitary fish, distinguished by quantities that biologists measure in a tank.

// Order of one school at one moment. Lengths in body lengths.
struct Order {
    float polarisation = 0; // length of the mean heading: 1 all alike, 0 all ways (Couzin et al. 2002)
    float nearest = 1e9f;   // neighbour, centre to centre, of any fish
    float meanNearest = 0;  // mean over all fish
    float farthest = 0;     // greatest distance from the school's middle
};

Order orderOf(const OpenDive& world, int school) {
    Order order;
    glm::vec3 heading(0);
    int count = 0;
    float length_m = 1;
    for (const Fish& a : world.fish) {
        if (a.school != school) continue;
        length_m = world.species()[a.species].length_m;
        heading += a.forward;
        ++count;
        float nearest = 1e9f;
        for (const Fish& b : world.fish)
            if (&a != &b && b.school == school)
                nearest = std::min(nearest, glm::distance(a.position, b.position) / length_m);
        order.nearest = std::min(order.nearest, nearest);
        order.meanNearest += nearest;
    }
    const auto n = static_cast<float>(count);
    order.polarisation = glm::length(heading) / n;
    order.meanNearest /= n;
    order.farthest = spreadOf(world, school);
    return order;
}

class Companions : public testing::TestWithParam<uint64_t> {};

TEST_P(Companions, ShoalsAlignAndPairsStayTogether) {
    OpenDive world(cove().species, calmCove(), GetParam());
    world.run(20);
    const auto& schools = world.file().schools;
    std::vector<double> polarisation(schools.size(), 0), nearest(schools.size(), 0);
    int samples = 0, shoals = 0, pairs = 0, nearPairs = 0;
    for (; samples < 200; ++samples) {
        world.run(0.2f);
        for (size_t s = 0; s < schools.size(); ++s) {
            const Order order = orderOf(world, static_cast<int>(s));
            polarisation[s] += order.polarisation;
            nearest[s] += order.meanNearest;
            if (world.species()[schools[s].species].company != Company::Shoal) continue;
            EXPECT_GT(order.nearest, 0.5f);
            // One that turns as a whole is out of order for a moment, but together.
            EXPECT_LT(order.farthest, 6);
        }
        for (const Fish& fish : world.fish) {
            const Species& kind = world.species()[fish.species];
            const Fish& partner = world.fish[static_cast<size_t>(fish.route.leader)];
            if (kind.company != Company::Pair || &partner == &fish) continue;
            EXPECT_EQ(partner.species, fish.species);
            ++pairs;
            nearPairs += glm::distance(fish.position, partner.position) < 3 * kind.length_m;
        }
    }
    EXPECT_GT(pairs, 0);
    EXPECT_GT(nearPairs, 0.9 * pairs);
    for (size_t s = 0; s < schools.size(); ++s) {
        const Species& kind = world.species()[schools[s].species];
        const double order = polarisation[s] / samples, apart = nearest[s] / samples;
        if (kind.company == Company::Shoal) {
            ++shoals;
            EXPECT_GT(order, 0.9) << kind.name;
            EXPECT_LT(apart, 1.5 * kind.spacing) << kind.name;
        } else if (schools[s].count > 2) {
            EXPECT_LT(order, 0.9) << kind.name; // two pairs that meet agree for a while
        }
        if (kind.company == Company::Alone) {
            EXPECT_GT(apart, 2.0) << kind.name;
        }
    }
    EXPECT_GE(shoals, 2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Companions, testing::Values(1, 2, 3));

TEST(Shoal, ScatteredByAFrightComesTogetherAgain) {
    OpenDive world(cove().species, calmCove(), 4);
    world.run(5);
    int school = 0;
    for (size_t i = 0; i < world.fish.size(); ++i) {
        const Fish& fish = world.fish[i];
        if (world.species()[fish.species].company != Company::Shoal) continue;
        school = fish.school;
        // Each is frightened from another side, so that they burst apart.
        const glm::vec3 from(i % 3 ? 0.2f : -0.2f, 0, i % 2 ? 0.2f : -0.2f);
        world.startle(static_cast<int>(i), fish.position + from);
    }
    float widest = 0;
    for (int i = 0; i < 20; ++i) {
        world.run(0.1f);
        widest = std::max(widest, orderOf(world, school).farthest);
    }
    world.run(18);
    EXPECT_GT(widest, 4);
    EXPECT_LT(orderOf(world, school).farthest, 4);
    EXPECT_GT(orderOf(world, school).polarisation, 0.8f);
}

// The cove without its shark, and a right hand that rests in view from the start.
struct RestingHand : OpenDive {
    explicit RestingHand(uint64_t seed, const SpeciesTable& species = cove().species)
        : OpenDive(species, calmCove(), seed) {
        input.hands[1] = handAt({0.05f, -0.1f, -0.7f});
    }
    int visitors() const {
        return static_cast<int>(std::ranges::count_if(fish, [](const Fish& f) { return f.visit.hand == 1; }));
    }
    float nearest() const {
        float least = 10;
        for (const Fish& f : fish) least = std::min(least, glm::distance(f.position, visitedPlace(hands[1])));
        return least;
    }
};

TEST(Curiosity, FishComeOneOrTwoAtATimeLingerAndLeave) {
    int dives = 0;
    for (uint64_t seed : {1, 2, 3, 4}) {
        RestingHand one(seed);
        int most = 0, there = 0;
        std::vector<bool> came(one.fish.size());
        for (int i = 0; i < 30 * 120; ++i) {
            one.step();
            most = std::max(most, one.visitors());
            there += one.nearest() < 0.1f;
            for (size_t f = 0; f < came.size(); ++f) came[f] = came[f] || one.fish[f].visit.hand == 1;
            if (i == 100) {
                EXPECT_EQ(most, 0) << "nobody comes within the first second";
            }
        }
        EXPECT_GE(most, 1);
        EXPECT_LE(most, 2);
        EXPECT_GE(std::ranges::count(came, true), 3) << "in turns, seed " << seed;
        dives += there > 3 * 120;
    }
    EXPECT_GE(dives, 3) << "of 30 s, somebody is before the palm for more than three";
}

TEST(Curiosity, AFastHandEndsAVisit) {
    RestingHand one(2);
    int ticks = 0;
    while (one.visitors() == 0 && ++ticks < 1200) one.step();
    ASSERT_GT(one.visitors(), 0);
    for (int i = 0; i < 24; ++i) { // 1 m/s
        one.input.hands[1] = handAt({0.05f - 0.2f * static_cast<float>(i) / 24, -0.1f, -0.7f});
        one.step();
    }
    EXPECT_EQ(one.visitors(), 0);
}

TEST(Curiosity, OnlyAnOpenHandInViewIsVisitedAndOnlyByTheCurious) {
    for (const hands::HandPose& hand : {handAt({0.05f, -0.1f, -0.7f}, 1), handAt({0.45f, -0.35f, -0.4f})}) {
        RestingHand one(3);
        one.input.hands[1] = hand;
        one.step(10 * 120);
        EXPECT_EQ(one.visitors(), 0);
    }
    SpeciesTable dull = cove().species;
    for (Species& kind : dull) kind.curiosity = 0;
    RestingHand ignored(3, dull);
    ignored.run(10);
    for (const Fish& f : ignored.fish) EXPECT_EQ(f.visit.hand, -1);
}

} // namespace
} // namespace shoal::game
