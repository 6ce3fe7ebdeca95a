// Suggestions for mistyped words.
#include "game/tools/NearestWord.h"

#include <gtest/gtest.h>

#include <vector>

namespace shoal::app {
namespace {

TEST(NearestWord, DistancesAreKnown) {
    EXPECT_EQ(editDistance("", ""), 0);
    EXPECT_EQ(editDistance("", "abc"), 3);
    EXPECT_EQ(editDistance("play", "play"), 0);
    EXPECT_EQ(editDistance("plya", "play"), 1); // a swap is one edit
    EXPECT_EQ(editDistance("kitten", "sitting"), 3);
    EXPECT_EQ(editDistance("ca", "abc"), 3); // 2 where a letter may be edited twice
    EXPECT_EQ(editDistance("sitting", "kitten"), editDistance("kitten", "sitting"));
}

TEST(NearestWord, OnlyWhatIsNearIsSuggested) {
    const std::vector<std::string> commands = {"play", "view", "light", "panorama", "check", "devices"};
    EXPECT_EQ(nearestWord("plya", commands), "play");
    EXPECT_EQ(nearestWord("pnorma", commands), "panorama");
    EXPECT_EQ(nearestWord("chekc", commands), "check");
    EXPECT_EQ(nearestWord("viw", commands), "view");
    EXPECT_EQ(nearestWord("swim", commands), "");
    EXPECT_EQ(nearestWord("pl", commands), "") << "half of its letters would change";
    EXPECT_EQ(nearestWord("", commands), "");
    EXPECT_EQ(nearestWord(std::string(100'000, 'x'), commands), "");
    EXPECT_EQ(didYouMean("lihgt", commands), "; did you mean light?");
    EXPECT_EQ(didYouMean("nonsense", commands), "");
}

} // namespace
} // namespace shoal::app
