// Animations: keys checked, rotations of length 1.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::scene {

struct Document;
struct Loading;

// Fills model.animations; nodes and meshes must be there. Channels that can move nothing are left out. Throws
// Fault.
void readAnimations(Loading& loading, const Document& document, Model& model);

} // namespace shoal::scene
