// The room files, for playthroughs on machines that decode no film, equal the rooms that the program makes of
// the films' depth tracks. With SHOAL_UPDATE=1 the files are written anew.
#include "tests/playthrough/Rooms.h"
#include "game/app/ContentLoader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace shoal::app {
namespace {

// Returns the distances that a space was made of: those in the middles of cells, at the times of steps.
game::Room roomIn(const game::FilmSpace& space, double length_s) {
    game::Room room{length_s, {}};
    for (int step = 0; step < space.steps(); ++step) {
        const auto moment = space.at((step + 1e-6) * length_s / space.steps());
        for (int cell = 0; cell < game::FilmSpace::kCells; ++cell)
            room.surface_mm.push_back(static_cast<uint16_t>(
                std::lround(1000 * space.surface_m(moment, game::FilmSpace::directionOf(cell)))));
    }
    return room;
}

TEST(Rooms, AreWhatTheProgramMakesOfTheFilms) {
    for (const std::string& dive : game::diveNames()) {
        const auto files = game::loadDiveFiles(dive);
        ASSERT_TRUE(files) << files.error().message();
        const Path film = dataRoot() / "content" / files->dive.video;
        const auto made = filmSpaceOf(film, 0);
        ASSERT_TRUE(made) << film;
        const Path file = game::roomFileOf(files->dive.video);
        if (std::getenv("SHOAL_UPDATE")) {
            ASSERT_TRUE(game::writeRoom(file, roomIn(*made, made->length_s()))) << file;
        }
        const auto kept = game::roomOf(files->dive.video);
        ASSERT_TRUE(kept) << kept.error().message();
        EXPECT_EQ((*kept)->hash(), made->hash()) << file << ": SHOAL_UPDATE=1 writes it anew";
    }
}

} // namespace
} // namespace shoal::app
