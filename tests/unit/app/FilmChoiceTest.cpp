// Slow machines play the small version of a film where there is one.
#include "engine/core/WriteFile.h"
#include "game/views/Environment.h"

#include "tests/TestPaths.h"

#include <gtest/gtest.h>

namespace shoal::app {
namespace {

TEST(FilmChoice, SlowMachinesPlayTheSmallVersionIfThereIsOne) {
    const tests::ScratchFolder folder;
    const Path best = folder / "sea.mp4", small = folder / "sea.small.mp4";
    ASSERT_TRUE(writeFileWhole(best, "b"));
    EXPECT_EQ(filmFor(best, FilmChoice::Auto, true), best);
    EXPECT_EQ(filmFor(best, FilmChoice::Small, false), best);
    ASSERT_TRUE(writeFileWhole(small, "s"));
    EXPECT_EQ(filmFor(best, FilmChoice::Auto, true), small);
    EXPECT_EQ(filmFor(best, FilmChoice::Auto, false), best);
    EXPECT_EQ(filmFor(best, FilmChoice::Small, false), small);
    EXPECT_EQ(filmFor(best, FilmChoice::Best, true), best);
}

} // namespace
} // namespace shoal::app
