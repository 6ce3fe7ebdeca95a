// The grid of distances that the rules read, made from the depth track beside a film.
#pragma once

#include "engine/core/Files.h"
#include "game/rules/FilmSpace.h"

#include <memory>

namespace shoal::app {

// yaw: of the environment about the player, radians to the right. Null where there is no track, or none that
// can be read (a warning says why). Opens the track for itself: who shows the film reads it on another thread,
// at another time. A few hundred frames are decoded: half a second.
std::shared_ptr<const game::FilmSpace> filmSpaceOf(const Path& film, float yaw);

} // namespace shoal::app
