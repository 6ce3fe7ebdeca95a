// Meshes of corals and plants, one of a kind at a time: about a metre high or wide, the root at the origin,
// +Y up.
#pragma once

#include "content/make/video/Mesh.h"

#include "engine/core/Random.h"

#include <string>

namespace shoal::reef {

// Empty for an unknown kind. Albedo: of the whole colony, chosen among its kind's colours.
Mesh makeColony(const std::string& kind, Random& random);
vec3 colonyAlbedo(const std::string& kind, Random& random);
// Returns whether plants of this kind move with the surge.
bool sways(const std::string& kind);
// 0: stands upright whatever the ground's slope; 1: stands off the ground.
float leans(const std::string& kind);

} // namespace shoal::reef
