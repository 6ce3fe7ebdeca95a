// One primitive's vertex attributes and morph targets, as they stand in the file, with their types checked.
#pragma once

#include "engine/scene/Model.h"
#include "engine/scene/TinyGltf.h"

#include <string>

namespace shoal::scene {

struct Document;
struct Loading;

// from.attributes must name POSITION. Normals, tangents of length 1, weights of sum 1 (the four heaviest,
// where there are eight). who: "meshes[0].primitives[1]". Throws Fault.
Primitive readAttributes(Loading& loading, const Document& document, const tinygltf::Primitive& from,
                         const std::string& who);

} // namespace shoal::scene
