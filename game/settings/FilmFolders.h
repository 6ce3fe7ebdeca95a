// The player's own films and photos, for the list on the screen.
#pragma once

#include "engine/core/Files.h"

#include <vector>

namespace shoal::app {

constexpr size_t kMaxFilms = 60;

// Returns the files in the folders for videos, pictures and downloads whose names end as those of films and
// photos that can be opened, newest first, at most kMaxFilms; subfolders are not searched.
std::vector<Path> filmsAndPhotos();

} // namespace shoal::app
