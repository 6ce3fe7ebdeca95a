// Writes the measurements as text and as data for the picture.
#pragma once

#include "engine/core/Files.h"
#include "tests/bench/occlusion/LayerQuality.h"
#include "tests/bench/occlusion/Measure.h"

namespace shoal::bench {

Status writeOcclusionMarkdown(const OcclusionChart& chart, const std::vector<LayerQuality>& layers,
                              const Path& folder);                             // occlusion.md
Status writeOcclusionPicture(const OcclusionChart& chart, const Path& folder); // occlusion.data.gp

// Root mean square over the environments, each weighing the same.
enum class Under { Reef, NoSuns, Suns };
double pooledError(const OcclusionChart& chart, const OcclusionMeasured& method, size_t scene, Under which,
                   double SceneError::*part = &SceneError::all);

} // namespace shoal::bench
