// How fish and shark swim when nobody disturbs them, over whole dives.
#include "Fixture.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <set>

namespace shoal::game {
namespace {

using test::cove;

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
    const Dive layout(files.species, files.dive, seed);
    Snapshot now, before;
    Events events;
    Statistics s;
    int frames = 0;
    dive.snapshot(before);
    for (int tick = 0; tick < seconds * 120; ++tick) {
        dive.step({}, events);
        dive.snapshot(now);
        for (size_t i = 0; i < now.creatures.size(); ++i)
            s.largestStep = std::max(s.largestStep,
                                     glm::distance(now.creatures[i].position, before.creatures[i].position));
        before = now;
        if (tick % 12) continue;
        ++frames;
        for (size_t i = 0; i < now.creatures.size(); ++i) {
            const CreatureView& c = now.creatures[i];
            const Species& kind = files.species[c.species];
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
            const School& school = files.dive.schools[layout.state().fish[i].school];
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
    const auto reef = loadDiveFiles("reef");
    ASSERT_TRUE(reef) << reef.error().message();
    EXPECT_EQ(reef->dive.duration_s, 90);
    EXPECT_EQ(reef->dive.video, "video/reef.mp4");
    int fish = 0;
    std::set<int> kinds;
    for (const School& school : reef->dive.schools) {
        fish += school.count;
        kinds.insert(school.species);
    }
    EXPECT_GE(fish, 24);
    EXPECT_GE(kinds.size(), 3u);
    EXPECT_GE(reef->dive.shark.species, 0);
    expectSwimWell(swimFor(*reef, 1, 90), reef->dive);
}

} // namespace
} // namespace shoal::game
