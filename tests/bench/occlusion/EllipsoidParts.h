// The ellipsoids by which the game represents bodies.
#pragma once

#include "content/make/models/occlusion/FitEllipsoids.h"
#include "content/make/models/occlusion/Silhouettes.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

// Returns the parts of a body, by bone.
std::vector<occlusion::BodyPart> partsOf(const Body& body);

// Returns the ellipsoid posed in the world.
occlusion::Occluder posed(const occlusion::BodyPart& part, const Body& body);

// Returns, for each body, the ellipsoids of all other bodies.
std::vector<std::vector<occlusion::Occluder>> castingOnOthers(const Scene& scene);

} // namespace shoal::bench
