// A player with a mouse and nothing but the picture, in several dives, points at a fish and clicks when the
// hand is there.
#include "tests/TestRig.h"
#include "tests/playthrough/Play.h"

#include <gtest/gtest.h>

namespace shoal::game {
namespace {

TEST(MousePlay, CatchesFishWithPointingAndClicking) {
    for (const bool inFilm : {false, true}) {
        auto dive = loadScriptedDive(dataRoot() / "tests/playthrough/mouse.toml", inFilm);
        ASSERT_TRUE(dive) << dive.error().message();
        int sum = 0;
        for (uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
            dive->script.seed = seed;
            const Played played = playScript(dive->script, tests::rig(), dive->files);
            EXPECT_GE(played.end.caught, 5) << "seed " << seed;
            EXPECT_LT(played.end.caught, 60) << "seed " << seed;
            sum += played.end.caught;
        }
        // Bounds of a difficulty that suits a game: dives differ by a third, the mean of eight by an eighth.
        EXPECT_GE(sum, 8 * 9);
        EXPECT_LE(sum, 8 * 17);
    }
}

} // namespace
} // namespace shoal::game
