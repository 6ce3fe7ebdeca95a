// Pictures of every scene side by side: nothing in the way, the methods, the truth.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

// occlusion_sheet.png in the folder, without words: a row a scene, columns as sheet.gp names them.
constexpr size_t kShownScenes = 6; // those of black bodies

Status writeSheet(std::span<const Scene> scenes, const Path& folder);

} // namespace shoal::bench
