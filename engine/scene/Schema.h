// Types and references of a glTF document, held against the specification before tinygltf sees it: tinygltf
// narrows 64-bit numbers, skips what has the wrong type, and trusts some indices.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>

namespace shoal::scene {

// Every member that this room reads has the right type; every number that names another element is the index
// of one; sizes and counts are 0 .. 2^31-1; numbers are finite as floats; the lists are within maxElements
// (accessors and bufferViews within four times that). Throws Fault naming the member.
void checkSchema(const nlohmann::json& document, uint32_t maxElements);

} // namespace shoal::scene
