// Which seed a dive has: what can be compared keeps it, what is played for pleasure is another each time.
#include "game/session/GameSession.h"

#include <gtest/gtest.h>

#include <set>

namespace shoal::app {
namespace {

uint64_t seedOf(const PlayOptions& options) {
    const auto config = makeSessionConfig(options);
    EXPECT_TRUE(config) << config.error().message();
    return config ? config->seed : 0;
}

TEST(Seed, IsDrawnForADiveInAWindow) {
    PlayOptions options;
    options.hands.source = "mouse";
    std::set<uint64_t> seeds;
    for (int i = 0; i < 4; ++i) seeds.insert(seedOf(options));
    EXPECT_GT(seeds.size(), 1u); // all equal once in 10^18 runs
    EXPECT_GE(*seeds.begin(), 100'000u);
    EXPECT_LE(*seeds.rbegin(), 999'999u);
}

TEST(Seed, IsOneWhereRunsAreCompared) {
    PlayOptions headless, timedemo;
    headless.headless = true;
    timedemo.timedemo = true;
    timedemo.hands.source = "mouse";
    EXPECT_EQ(seedOf(headless), 1u);
    EXPECT_EQ(seedOf(timedemo), 1u);
}

TEST(Seed, IsWhatIsAskedFor) {
    PlayOptions options;
    options.hands.source = "mouse";
    options.seed = 7;
    EXPECT_EQ(seedOf(options), 7u);
    options.headless = true;
    EXPECT_EQ(seedOf(options), 7u);
    options.seed.reset();
    options.headless = false;
    options.hands.source = "script:" + (dataRoot() / "tests/playthrough/first_catch.toml").string();
    EXPECT_EQ(seedOf(options), seedOf(options));
}

} // namespace
} // namespace shoal::app
