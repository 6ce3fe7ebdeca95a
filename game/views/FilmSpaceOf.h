// Makes the rules' grid of distances from the depth track beside a film.
#pragma once

#include "engine/core/Files.h"
#include "game/rules/FilmSpace.h"

#include <memory>

namespace shoal::app {

// Returns the grid; null without a track, or with one that cannot be read (a warning says why). yaw: turn of
// the environment about the player, radians to the right. Opens the track a second time, because the film's
// player reads other frames of it on another thread. Decodes a few hundred frames, in half a second.
std::shared_ptr<const game::FilmSpace> filmSpaceOf(const Path& film, float yaw);

} // namespace shoal::app
