// Numbers out of accessors: any component type, stride, normalization, sparse or not.
#pragma once

#include "engine/scene/TinyGltf.h"

#include <cstdint>
#include <vector>

namespace shoal::scene {

struct Loading;

// Every bufferView lies in its buffer, every accessor and its sparse part in their bufferViews, component
// types and element types exist, counts are at least 1. Throws Fault. The functions below rely on it.
void checkAccessors(Loading& loading, const tinygltf::Model& gltf);

// Components of one element: 1 for SCALAR ... 16 for MAT4.
int componentCount(const tinygltf::Accessor& accessor);

// count * components numbers, matrices by columns without their padding. Normalized integers become -1 .. 1
// or 0 .. 1 (glTF 2.0 specification, 3.6.2.2), other integers keep their value. Throws Fault for numbers that
// are not finite. Callers have held accessor.count against their limit: this takes count * components * 4
// bytes.
std::vector<float> readFloats(const tinygltf::Model& gltf, int accessor);

// The same for integers without sign or normalization.
std::vector<uint32_t> readIntegers(const tinygltf::Model& gltf, int accessor);

} // namespace shoal::scene
