// Pictures of every scene side by side: without occlusion, by the methods, and the truth.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

// Writes occlusion_sheet.png, without text: a row for each scene, columns as sheet.gp names them.
constexpr size_t kShownScenes = 6; // those of black bodies

Status writeSheet(std::span<const Scene> scenes, const Path& folder);

} // namespace shoal::bench
