// The ellipsoids that the game gives bodies.
#pragma once

#include "content/make/models/occlusion/FitEllipsoids.h"
#include "content/make/models/occlusion/Silhouettes.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

// Parts of a body, by bone.
std::vector<occlusion::BodyPart> partsOf(const Body& body);

// The ellipsoid as it stands in the world.
occlusion::Occluder posed(const occlusion::BodyPart& part, const Body& body);

// [body]: those of all the others.
std::vector<std::vector<occlusion::Occluder>> castingOnOthers(const Scene& scene);

} // namespace shoal::bench
