// Occlusion of a model: stored beside it or, for a model without, made once by shoal-occlusion and kept in
// the player's cache folder.
#pragma once

#include "engine/render/BakedOcclusion.h"

#include <optional>

namespace shoal::app {

// Gives the model its self-occlusion and returns its ellipsoids. If none is stored and none can be made, logs
// why and returns nothing. Making takes seconds. Any thread.
std::optional<render::BakedOcclusion> occlusionOf(const Path& file, scene::Model& model);

} // namespace shoal::app
