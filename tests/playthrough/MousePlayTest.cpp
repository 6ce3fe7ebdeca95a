// Somebody with a mouse and nothing but the picture, in several dives: points at a fish, clicks when the hand
// is there.
#include "tests/playthrough/Play.h"
#include "tests/playthrough/Rooms.h"

#include <gtest/gtest.h>

namespace shoal::game {
namespace {

TEST(MousePlay, CatchesFishWithPointingAndClicking) {
    auto script = loadScript(dataRoot() / "tests/playthrough/mouse.toml");
    ASSERT_TRUE(script) << script.error().message();
    auto files = loadDiveFiles(*script);
    ASSERT_TRUE(files) << files.error().message();
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    ASSERT_TRUE(rig) << rig.error().message();
    for (const bool inFilm : {false, true}) {
        if (inFilm) {
            ASSERT_TRUE(roomOf(files->dive.video).moveTo(files->dive.space));
        }
        int sum = 0;
        for (uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
            script->seed = seed;
            const Played played = playScript(*script, *rig, *files);
            std::printf("seed %d: %d caught, %d lost, %d points\n", static_cast<int>(seed), played.end.caught,
                        played.end.lost, played.end.score);
            EXPECT_GE(played.end.caught, 5) << "seed " << seed;
            EXPECT_LT(played.end.caught, 60) << "seed " << seed;
            sum += played.end.caught;
        }
        // A game should be as hard as this: single dives differ by a third, the mean of eight by an eighth.
        EXPECT_GE(sum, 8 * 9);
        EXPECT_LE(sum, 8 * 17);
    }
}

} // namespace
} // namespace shoal::game
