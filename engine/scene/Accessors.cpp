#include "engine/scene/Gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace shoal::scene {

namespace {

// Returns 0 for what is no component type of glTF.
size_t componentBytes(int componentType) {
    constexpr std::array<size_t, 7> kBytes = {1, 1, 2, 2, 0, 4, 4}; // from kByte on
    return componentType < kByte || componentType > kFloat ? 0 : kBytes[componentType - kByte];
}

// Returns the address of `count` pieces of `bytes` every `stride` bytes of a bufferView; it must hold them
// all. All numbers are below 2^31 (checkSchema), so nothing here overflows 64 bits.
const uint8_t* piecesOf(const GltfFile& file, size_t bufferView, size_t byteOffset, size_t count,
                        size_t stride, size_t bytes, const std::string& who) {
    const BufferView& view = file.bufferViews[bufferView];
    const uint64_t end = byteOffset + stride * (count - 1) + bytes;
    if (end > view.byteLength)
        fault(who, " reaches past the end of ", element("bufferViews", bufferView), " (", end, " bytes of ",
              view.byteLength, ")");
    return file.bytesOf(view).data() + byteOffset;
}

template <class T, class Stored> T load(const uint8_t* from, bool normalized) {
    Stored stored;
    std::memcpy(&stored, from, sizeof stored);
    if (!normalized) return static_cast<T>(stored);
    const float share = static_cast<float>(stored) / static_cast<float>(std::numeric_limits<Stored>::max());
    return static_cast<T>(std::max(share, -1.0f));
}

template <class T> T loadComponent(const uint8_t* from, int componentType, bool normalized) {
    switch (componentType) {
    case kByte:
        return load<T, int8_t>(from, normalized);
    case kUnsignedByte:
        return load<T, uint8_t>(from, normalized);
    case kShort:
        return load<T, int16_t>(from, normalized);
    case kUnsignedShort:
        return load<T, uint16_t>(from, normalized);
    case kUnsignedInt:
        return load<T, uint32_t>(from, false);
    default:
        return load<T, float>(from, false);
    }
}

// Calls put(element, its bytes) for all elements, then for the sparse ones. Checks where they lie before the
// first.
template <class Put> void forEachElement(const GltfFile& file, size_t index, Put&& put) {
    const std::string who = element("accessors", index);
    const Accessor& a = file.accessors[index];
    const size_t bytes = a.components * componentBytes(a.componentType);
    if (a.bufferView >= 0) {
        const auto view = static_cast<size_t>(a.bufferView);
        const size_t viewStride = file.bufferViews[view].byteStride;
        if (viewStride != 0 && viewStride < bytes)
            fault(who, " has elements longer than the byteStride of ", element("bufferViews", view));
        const size_t stride = viewStride != 0 ? viewStride : bytes;
        const uint8_t* from = piecesOf(file, view, a.byteOffset, a.count, stride, bytes, who);
        for (size_t i = 0; i < a.count; ++i) put(i, from + i * stride);
    }
    if (!a.sparse) return;
    const Json &where = (*a.sparse)["indices"], &what = (*a.sparse)["values"];
    const size_t count = (*a.sparse)["count"];
    const int type = where["componentType"];
    const size_t size = componentBytes(type);
    if (count < 1 || count > a.count) fault(who, ".sparse.count is ", count, ", not 1 .. ", a.count);
    if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)
        fault(who, ".sparse.indices.componentType is ", type, ", no unsigned integer type");
    const uint8_t* const indices = piecesOf(file, where["bufferView"], where.value("byteOffset", size_t{0}),
                                            count, size, size, who + ".sparse.indices");
    const uint8_t* const values = piecesOf(file, what["bufferView"], what.value("byteOffset", size_t{0}),
                                           count, bytes, bytes, who + ".sparse.values");
    int64_t previous = -1;
    for (size_t i = 0; i < count; ++i) {
        const auto to = loadComponent<uint32_t>(indices + i * size, type, false);
        if (to >= a.count || to <= previous)
            fault(who, ".sparse.indices: number ", i, " is ", to, ", not rising below ", a.count);
        put(to, values + i * bytes);
        previous = to;
    }
}

template <class T> std::vector<T> readNumbers(const GltfFile& file, size_t index) {
    const Accessor& a = file.accessors[index];
    const size_t size = componentBytes(a.componentType);
    std::vector<T> values(a.count * a.components);
    forEachElement(file, index, [&](size_t i, const uint8_t* from) {
        for (size_t k = 0; k < a.components; ++k)
            values[i * a.components + k] = loadComponent<T>(from + k * size, a.componentType, a.normalized);
    });
    return values;
}

void readBufferViews(GltfFile& file) {
    for (const Json& from : member(file.root, "bufferViews")) {
        const std::string who = element("bufferViews", file.bufferViews.size());
        const bool compressed = !extension(from, "EXT_meshopt_compression").empty();
        const BufferView view = compressed
                                    ? decompressed(file, from, who)
                                    : BufferView{from["buffer"], from.value("byteOffset", size_t{0}),
                                                 from["byteLength"], from.value("byteStride", size_t{0})};
        if (view.byteLength < 1) fault(who, ".byteLength is 0");
        const size_t size = file.buffers[view.buffer].size(), end = view.byteOffset + view.byteLength;
        if (end > size)
            fault(who, " reaches past the end of ", element("buffers", view.buffer), " (", end, " bytes of ",
                  size, ")");
        file.bufferViews.push_back(view);
    }
}

} // namespace

void readAccessors(GltfFile& file) {
    static const std::map<std::string, size_t> kComponents = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    readBufferViews(file);
    for (const Json& from : member(file.root, "accessors")) {
        const size_t index = file.accessors.size();
        const std::string who = element("accessors", index), type = from["type"];
        const auto components = kComponents.find(type);
        if (components == kComponents.end()) fault(who, ".type is ", quoted(type), ", no type of glTF");
        const auto sparse = from.find("sparse");
        const Accessor& a = file.accessors.emplace_back(
            Accessor{type, components->second, from["componentType"], from.value("normalized", false),
                     from["count"], from.value("byteOffset", size_t{0}), from.value("bufferView", -1),
                     sparse == from.end() ? nullptr : &*sparse});
        const size_t component = componentBytes(a.componentType);
        if (component == 0) fault(who, ".componentType is ", a.componentType, ", no type of glTF");
        if (a.count < 1) fault(who, ".count is 0");
        if (a.normalized && component == 4)
            fault(who, ".normalized is true, but its type cannot be normalized");
        forEachElement(file, index, [](size_t, const uint8_t*) {});
        if (a.bufferView >= 0 && (file.bufferViews[a.bufferView].byteOffset + a.byteOffset) % component != 0)
            file.warn(who, " does not start at a multiple of its component size");
    }
}

std::vector<float> readFloats(const GltfFile& file, size_t accessor) {
    std::vector<float> values = readNumbers<float>(file, accessor);
    const auto bad = std::find_if_not(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
    if (bad != values.end())
        fault(element("accessors", accessor), ": element ",
              static_cast<size_t>(bad - values.begin()) / file.accessors[accessor].components,
              " is not finite");
    return values;
}

std::vector<uint32_t> readIntegers(const GltfFile& file, size_t accessor) {
    return readNumbers<uint32_t>(file, accessor);
}

} // namespace shoal::scene
