// Material variants of a model: the glTF extension KHR_materials_variants.
#pragma once

#include "engine/scene/Model.h"

#include <nlohmann/json_fwd.hpp>

namespace shoal::scene {

struct Variants {
    std::vector<std::string> names;
    std::vector<std::vector<std::vector<int>>>
        materials; // by mesh, primitive and variant; -1: the primitive's own
};

// root: the document with its extensions, unchecked. Throws Fault.
Variants readVariants(const nlohmann::json& root);

// Primitive::variantMaterials of the file's mesh and primitive; materials: how many there are. Throws Fault.
std::vector<int> variantMaterials(const Variants& variants, size_t mesh, size_t primitive, size_t materials);

} // namespace shoal::scene
