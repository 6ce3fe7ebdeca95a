// Meshes of corals and plants, one of a kind at a time: about a metre high or wide, the root at the origin,
// +Y up.
#pragma once

#include "content/make/video/Mesh.h"

#include "engine/core/Random.h"

#include <string>

namespace shoal::reef {

// Returns an empty mesh for an unknown kind. colonyAlbedo() varies one of the kind's colours for a colony.
Mesh makeColony(const std::string& kind, Random& random);
vec3 colonyAlbedo(const std::string& kind, Random& random);
// Returns whether plants of this kind move with the surge.
bool sways(const std::string& kind);
// Returns 0 for plants that stand upright on any slope, up to 1 for plants along the ground's normal.
float leans(const std::string& kind);

} // namespace shoal::reef
