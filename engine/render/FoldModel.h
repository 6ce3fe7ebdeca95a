// A model's folds, found by rays from its vertices.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::render {

// Fills Primitive::folds of every mesh, as it hides itself in this pose, which should be the rest pose: folds
// go with the joints that move them. Meshes hung up more than once keep what the last place says. Not where a
// material brings a map of its occlusion.
void foldModel(scene::Model& model, const scene::Pose& rest, int rays);

} // namespace shoal::render
