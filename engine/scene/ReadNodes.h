// Nodes, the default scene and skins.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::scene {

struct Document;
struct Loading;

// Fills model.nodes, order and skins. The nodes form trees; every skinned node in the scene has its joints
// there. Throws Fault.
void readNodes(Loading& loading, const Document& document, Model& model);

// The transform that gives this affine matrix, if there is one (no shear, no flattened axis).
std::optional<Transform> split(const glm::mat4& parentFromNode);

} // namespace shoal::scene
