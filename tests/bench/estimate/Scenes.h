// Synthetic films of known depth: a ray caster draws textured spheres and a floor. Each scene has one thing
// that makes depth hard to estimate.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

namespace shoal::bench {

// Writes NAME.mp4 and the truth, NAME.truth.mkv, of each scene to the folder, where they are not there yet.
Status makeScenes(const Path& folder);

} // namespace shoal::bench
