// Pictures of animals on which the sun's light changes over a second, traced and as the game draws them.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <span>

namespace shoal::bench {

// Writes the animals' meshes as FOLDER/NAME.mesh, for make_video_frames.
Status writeAnimals(const Path& folder);

// Reads the reef's traced frames, FOLDER/NAME_NNNN.hdr. Writes FOLDER/caustics.png, which has for each animal
// a row that is traced, one by the game, and one by the game without what waves change, and a column for each
// frame; and FOLDER/animals.md, how much the light on them changes.
Status writePictures(const Path& folder, std::span<const int> frames);

} // namespace shoal::bench
