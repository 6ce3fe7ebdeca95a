#include "engine/scene/Gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace shoal::scene {

namespace {

// Returns the size of a component; 0 for a type that glTF does not have.
size_t componentBytes(int componentType) {
    const int bytes =
        componentType == TINYGLTF_COMPONENT_TYPE_DOUBLE || componentType == TINYGLTF_COMPONENT_TYPE_INT
            ? 0
            : tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType));
    return static_cast<size_t>(std::max(bytes, 0));
}

// Returns the first of `count` pieces of `bytes`, one every `stride` bytes of a bufferView; faults if they do
// not fit into it. All numbers are below 2^31 (checkSchema), so nothing here overflows 64 bits.
const uint8_t* piecesOf(const tinygltf::Model& gltf, int bufferView, size_t byteOffset, size_t count,
                        size_t stride, size_t bytes, const std::string& who) {
    const tinygltf::BufferView& view = gltf.bufferViews[bufferView];
    const uint64_t end = byteOffset + stride * (count - 1) + bytes;
    if (end > view.byteLength)
        fault(who, " reaches past the end of ", element("bufferViews", bufferView), " (", end, " bytes of ",
              view.byteLength, ")");
    return gltf.buffers[view.buffer].data.data() + view.byteOffset + byteOffset;
}

double loadComponent(const uint8_t* from, int componentType, bool normalized) {
    const auto load = [&]<class Stored>(Stored stored) {
        std::memcpy(&stored, from, sizeof stored);
        if (!normalized) return static_cast<double>(stored);
        constexpr auto kOne = static_cast<float>(std::numeric_limits<Stored>::max());
        return static_cast<double>(std::max(static_cast<float>(stored) / kOne, -1.0f));
    };
    if (componentType == TINYGLTF_COMPONENT_TYPE_BYTE) return load(int8_t{});
    if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return load(uint8_t{});
    if (componentType == TINYGLTF_COMPONENT_TYPE_SHORT) return load(int16_t{});
    if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load(uint16_t{});
    if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return load(uint32_t{});
    return load(float{});
}

// Calls put(index, its bytes) for all elements, then for the sparse ones. Checks the range of each part
// before its first call.
template <class Put> void forEachElement(const tinygltf::Model& gltf, int index, Put&& put) {
    const std::string who = element("accessors", index);
    const tinygltf::Accessor& a = gltf.accessors[index];
    // Matrices whose columns would be padded to 4 bytes are never read.
    const size_t bytes = componentCount(a) * componentBytes(a.componentType);
    if (a.bufferView >= 0) {
        const size_t viewStride = gltf.bufferViews[a.bufferView].byteStride;
        if (viewStride != 0 && viewStride < bytes)
            fault(who, " has elements longer than the byteStride of ", element("bufferViews", a.bufferView));
        const size_t stride = viewStride != 0 ? viewStride : bytes;
        const uint8_t* from = piecesOf(gltf, a.bufferView, a.byteOffset, a.count, stride, bytes, who);
        for (size_t i = 0; i < a.count; ++i) put(i, from + i * stride);
    }
    if (!a.sparse.isSparse) return;
    const auto& sparse = a.sparse;
    const size_t count = sparse.count, size = componentBytes(sparse.indices.componentType);
    if (count < 1 || count > a.count) fault(who, ".sparse.count is ", count, ", not 1 .. ", a.count);
    if (sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fault(who, ".sparse.indices.componentType is ", sparse.indices.componentType,
              ", no unsigned integer type");
    const uint8_t* const indices = piecesOf(gltf, sparse.indices.bufferView, sparse.indices.byteOffset, count,
                                            size, size, who + ".sparse.indices");
    const uint8_t* const values = piecesOf(gltf, sparse.values.bufferView, sparse.values.byteOffset, count,
                                           bytes, bytes, who + ".sparse.values");
    int64_t previous = -1;
    for (size_t i = 0; i < count; ++i) {
        const auto to =
            static_cast<uint32_t>(loadComponent(indices + i * size, sparse.indices.componentType, false));
        if (to >= a.count || to <= previous)
            fault(who, ".sparse.indices: number ", i, " is ", to, ", not rising below ", a.count);
        put(to, values + i * bytes);
        previous = to;
    }
}

template <class T> std::vector<T> readNumbers(const tinygltf::Model& gltf, int index) {
    const tinygltf::Accessor& a = gltf.accessors[index];
    const size_t components = componentCount(a), size = componentBytes(a.componentType);
    std::vector<T> values(a.count * components);
    forEachElement(gltf, index, [&](size_t i, const uint8_t* from) {
        for (size_t k = 0; k < components; ++k)
            values[i * components + k] =
                static_cast<T>(loadComponent(from + k * size, a.componentType, a.normalized));
    });
    return values;
}

} // namespace

void checkAccessors(GltfFile& file) {
    const tinygltf::Model& gltf = file.gltf;
    for (size_t i = 0; i < gltf.bufferViews.size(); ++i) {
        const tinygltf::BufferView& view = gltf.bufferViews[i];
        const std::string who = element("bufferViews", i);
        if (view.byteLength < 1) fault(who, ".byteLength is 0");
        const size_t size = gltf.buffers[view.buffer].data.size(), end = view.byteOffset + view.byteLength;
        if (end > size)
            fault(who, " reaches past the end of ", element("buffers", view.buffer), " (", end, " bytes of ",
                  size, ")");
    }
    for (size_t i = 0; i < gltf.accessors.size(); ++i) {
        const tinygltf::Accessor& a = gltf.accessors[i];
        const std::string who = element("accessors", i);
        const size_t component = componentBytes(a.componentType);
        if (component == 0) fault(who, ".componentType is ", a.componentType, ", no type of glTF");
        if (a.count < 1) fault(who, ".count is 0");
        if (a.normalized && component == 4)
            fault(who, ".normalized is true, but its type cannot be normalized");
        forEachElement(gltf, static_cast<int>(i), [](size_t, const uint8_t*) {});
        if (a.bufferView >= 0 && (gltf.bufferViews[a.bufferView].byteOffset + a.byteOffset) % component != 0)
            file.warn(who, " does not start at a multiple of its component size");
    }
}

size_t componentCount(const tinygltf::Accessor& accessor) {
    return static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
}

std::vector<float> readFloats(const tinygltf::Model& gltf, int accessor) {
    std::vector<float> values = readNumbers<float>(gltf, accessor);
    const auto bad = std::ranges::find_if_not(values, [](float v) { return std::isfinite(v); });
    if (bad != values.end())
        fault(element("accessors", accessor), ": element ",
              static_cast<size_t>(bad - values.begin()) / componentCount(gltf.accessors[accessor]),
              " is not finite");
    return values;
}

std::vector<uint32_t> readIntegers(const tinygltf::Model& gltf, int accessor) {
    return readNumbers<uint32_t>(gltf, accessor);
}

} // namespace shoal::scene
