// The seed of a dive: the same in dives that can be compared, and another each time in dives for pleasure.
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
    EXPECT_EQ(seedOf({.headless = true}), 1u);
    EXPECT_EQ(seedOf({.hands = {.source = "mouse"}, .timedemo = true}), 1u);
    const std::string script = "script:" + (dataRoot() / "tests/playthrough/first_catch.toml").string();
    EXPECT_EQ(seedOf({.hands = {.source = script}}), seedOf({.hands = {.source = script}}));
}

TEST(Seed, IsWhatIsAskedFor) {
    EXPECT_EQ(seedOf({.seed = 7, .hands = {.source = "mouse"}}), 7u);
    EXPECT_EQ(seedOf({.seed = 7, .headless = true}), 7u);
}

} // namespace
} // namespace shoal::app
