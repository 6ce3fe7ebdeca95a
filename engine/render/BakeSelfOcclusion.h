// A model's self-occlusion, found by rays from its surface.
#pragma once

#include "engine/render/BodyOccluders.h"

namespace shoal::render {

// Fills Primitive::self-occlusion of every mesh, as it hides itself in this pose, which should be the rest
// pose: self-occlusion go with the joints that move them. What is blended neither hides nor self-occlusion.
// Meshes hung up more than once keep what the last place says. Not where a material brings a map of its
// occlusion. rays: from each of three points in a triangle.
void bakeSelfOcclusion(scene::Model& model, const scene::Pose& rest, int rays);

// Likewise Primitive::selfOcclusionBesideOwn, which take the place of the others once the body's own parts
// count in full (BodyOccluders.h): in a pose so bent.
void bakeSelfOcclusionBesideOwn(scene::Model& model, const scene::Pose& bent, const BodyOccluders& body,
                                int rays);

} // namespace shoal::render
