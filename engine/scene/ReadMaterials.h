// Images, textures and materials.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::scene {

struct Document;
struct Loading;

// Fills model.materials, model.textures and those of model.images that a material shows; the others stay
// empty. Throws Fault.
void readMaterials(Loading& loading, const Document& document, Model& model);

} // namespace shoal::scene
