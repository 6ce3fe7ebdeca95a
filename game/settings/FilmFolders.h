// The player's own films and photos, for the list on the screen.
#pragma once

#include "engine/core/Files.h"

#include <vector>

namespace shoal::app {

constexpr size_t kMaxFilms = 60;

// Files in the folders for videos, pictures and downloads whose names end as those of films and photos that
// can be opened, the newest first; folders in them are not searched. At most kMaxFilms.
std::vector<Path> filmsAndPhotos();

} // namespace shoal::app
