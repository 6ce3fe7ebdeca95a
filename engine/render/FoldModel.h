// A model's folds, found by rays from its surface.
#pragma once

#include "engine/render/BodyOccluders.h"

namespace shoal::render {

// Fills Primitive::folds of every mesh, as it hides itself in this pose, which should be the rest pose: folds
// go with the joints that move them. What is blended neither hides nor folds. Meshes hung up more than once
// keep what the last place says. Not where a material brings a map of its occlusion. rays: from each of three
// points in a triangle.
void foldModel(scene::Model& model, const scene::Pose& rest, int rays);

// Likewise Primitive::foldsBesideOwn, which take the place of the others once the body's own parts count in
// full (BodyOccluders.h): in a pose so bent.
void foldBesideOwn(scene::Model& model, const scene::Pose& bent, const BodyOccluders& body, int rays);

} // namespace shoal::render
