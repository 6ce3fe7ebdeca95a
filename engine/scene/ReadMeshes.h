// Meshes: triangles, attributes, morph targets.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::scene {

struct Document;
struct Loading;

// Fills model.meshes; nodes, skins and materials must be there. Primitives that are no triangles are left out
// with a warning. Throws Fault.
void readMeshes(Loading& loading, const Document& document, Model& model);

} // namespace shoal::scene
