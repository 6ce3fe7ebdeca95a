#include "engine/scene/Accessors.h"

#include "engine/scene/Loading.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace shoal::scene {

namespace {

// 0 for what is no component type of glTF.
size_t componentBytes(int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

struct Layout {
    int columns = 0, rows = 0;
    size_t bytesPerComponent = 0;
    size_t columnStride = 0; // matrix columns start at multiples of 4 bytes

    int components() const { return columns * rows; }
    size_t bytes() const {
        return static_cast<size_t>(columns - 1) * columnStride +
               static_cast<size_t>(rows) * bytesPerComponent;
    }
    size_t tightStride() const { return static_cast<size_t>(columns) * columnStride; }
};

Layout layoutOf(const tinygltf::Accessor& accessor) {
    Layout layout;
    layout.bytesPerComponent = componentBytes(accessor.componentType);
    const bool matrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
                        accessor.type == TINYGLTF_TYPE_MAT4;
    layout.rows = accessor.type == TINYGLTF_TYPE_SCALAR ? 1 : accessor.type & 15; // tinygltf's numbering
    layout.columns = matrix ? layout.rows : 1;
    layout.columnStride = static_cast<size_t>(layout.rows) * layout.bytesPerComponent;
    if (matrix) layout.columnStride = (layout.columnStride + 3) / 4 * 4;
    return layout;
}

size_t strideOf(const tinygltf::BufferView& view, const Layout& layout) {
    return view.byteStride != 0 ? view.byteStride : layout.tightStride();
}

const uint8_t* bytesOf(const tinygltf::Model& gltf, int bufferView, size_t byteOffset) {
    const tinygltf::BufferView& view = gltf.bufferViews[static_cast<size_t>(bufferView)];
    return gltf.buffers[static_cast<size_t>(view.buffer)].data.data() + view.byteOffset + byteOffset;
}

// All numbers are below 2^31 (checkSchema), so nothing here overflows 64 bits.
void checkReach(const tinygltf::Model& gltf, int bufferView, size_t byteOffset, size_t count, size_t stride,
                size_t bytes, const std::string& who) {
    const tinygltf::BufferView& view = gltf.bufferViews[static_cast<size_t>(bufferView)];
    const uint64_t end = uint64_t{byteOffset} + uint64_t{stride} * (count - 1) + bytes;
    if (end > view.byteLength)
        fault(who, " reaches past the end of ", element("bufferViews", bufferView), " (", end, " bytes of ",
              view.byteLength, ")");
}

template <class T> T load(const uint8_t* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

uint32_t loadUnsigned(const uint8_t* from, size_t bytes) {
    if (bytes == 1) return *from;
    if (bytes == 2) return load<uint16_t>(from);
    return load<uint32_t>(from);
}

float loadFloat(const uint8_t* from, int componentType, bool normalized) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const float value = load<int8_t>(from);
        return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
        const float value = *from;
        return normalized ? value / 255.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const float value = load<int16_t>(from);
        return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        const float value = load<uint16_t>(from);
        return normalized ? value / 65535.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return static_cast<float>(load<uint32_t>(from));
    default:
        return load<float>(from);
    }
}

void checkSparse(const tinygltf::Model& gltf, const tinygltf::Accessor& accessor, const Layout& layout,
                 const std::string& who) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<size_t>(sparse.count);
    if (count < 1 || count > accessor.count)
        fault(who, ".sparse.count is ", count, ", not 1 .. ", accessor.count);
    const size_t indexBytes = componentBytes(sparse.indices.componentType);
    if (indexBytes == 0 || sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
        sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
        sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_SHORT)
        fault(who, ".sparse.indices.componentType is ", sparse.indices.componentType,
              ", no unsigned integer type");
    const auto indexOffset = static_cast<size_t>(sparse.indices.byteOffset);
    checkReach(gltf, sparse.indices.bufferView, indexOffset, count, indexBytes, indexBytes,
               who + ".sparse.indices");
    checkReach(gltf, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), count,
               layout.tightStride(), layout.bytes(), who + ".sparse.values");

    const uint8_t* indices = bytesOf(gltf, sparse.indices.bufferView, indexOffset);
    int64_t previous = -1;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t index = loadUnsigned(indices + i * indexBytes, indexBytes);
        if (index >= accessor.count || index <= previous)
            fault(who, ".sparse.indices: number ", i, " is ", index, ", not rising below ", accessor.count);
        previous = index;
    }
}

void checkBufferViews(const tinygltf::Model& gltf) {
    for (size_t i = 0; i < gltf.bufferViews.size(); ++i) {
        const tinygltf::BufferView& view = gltf.bufferViews[i];
        const std::string who = element("bufferViews", static_cast<int64_t>(i));
        if (view.byteLength < 1) fault(who, ".byteLength is 0");
        const size_t size = gltf.buffers[static_cast<size_t>(view.buffer)].data.size();
        const uint64_t end = uint64_t{view.byteOffset} + view.byteLength;
        if (end > size)
            fault(who, " reaches past the end of ", element("buffers", view.buffer), " (", end, " bytes of ",
                  size, ")");
    }
}

// Calls put(element, component, address of the component) for each component, the sparse ones last.
template <class Put>
void forEachComponent(const tinygltf::Model& gltf, const tinygltf::Accessor& a, Put&& put) {
    const Layout layout = layoutOf(a);
    const auto putElement = [&](size_t element, const uint8_t* from) {
        for (int column = 0; column < layout.columns; ++column)
            for (int row = 0; row < layout.rows; ++row)
                put(element, static_cast<size_t>(column * layout.rows + row),
                    from + static_cast<size_t>(column) * layout.columnStride +
                        static_cast<size_t>(row) * layout.bytesPerComponent);
    };
    if (a.bufferView >= 0) {
        const size_t stride = strideOf(gltf.bufferViews[static_cast<size_t>(a.bufferView)], layout);
        const uint8_t* from = bytesOf(gltf, a.bufferView, a.byteOffset);
        for (size_t i = 0; i < a.count; ++i) putElement(i, from + i * stride);
    }
    if (!a.sparse.isSparse) return;
    const size_t indexBytes = componentBytes(a.sparse.indices.componentType);
    const uint8_t* indices =
        bytesOf(gltf, a.sparse.indices.bufferView, static_cast<size_t>(a.sparse.indices.byteOffset));
    const uint8_t* values =
        bytesOf(gltf, a.sparse.values.bufferView, static_cast<size_t>(a.sparse.values.byteOffset));
    for (size_t i = 0; i < static_cast<size_t>(a.sparse.count); ++i)
        putElement(loadUnsigned(indices + i * indexBytes, indexBytes), values + i * layout.tightStride());
}

} // namespace

void checkAccessors(Loading& loading, const tinygltf::Model& gltf) {
    checkBufferViews(gltf);
    for (size_t i = 0; i < gltf.accessors.size(); ++i) {
        const tinygltf::Accessor& accessor = gltf.accessors[i];
        const std::string who = element("accessors", static_cast<int64_t>(i));
        const Layout layout = layoutOf(accessor);
        if (layout.bytesPerComponent == 0)
            fault(who, ".componentType is ", accessor.componentType, ", no type of glTF");
        if (accessor.count < 1) fault(who, ".count is 0");
        const bool whole = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                           accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        if (accessor.normalized && whole)
            fault(who, ".normalized is true, but its type cannot be normalized");
        if (accessor.bufferView >= 0) {
            const tinygltf::BufferView& view = gltf.bufferViews[static_cast<size_t>(accessor.bufferView)];
            if (view.byteStride != 0 && view.byteStride < layout.bytes())
                fault(who, " has elements longer than the byteStride of ",
                      element("bufferViews", accessor.bufferView));
            checkReach(gltf, accessor.bufferView, accessor.byteOffset, accessor.count, strideOf(view, layout),
                       layout.bytes(), who);
            if ((view.byteOffset + accessor.byteOffset) % layout.bytesPerComponent != 0)
                loading.warn(who, " does not start at a multiple of its component size");
        }
        if (accessor.sparse.isSparse) checkSparse(gltf, accessor, layout, who);
    }
}

int componentCount(const tinygltf::Accessor& accessor) { return layoutOf(accessor).components(); }

std::vector<float> readFloats(const tinygltf::Model& gltf, int accessor) {
    const tinygltf::Accessor& a = gltf.accessors[static_cast<size_t>(accessor)];
    const auto components = static_cast<size_t>(componentCount(a));
    std::vector<float> values(a.count * components);
    forEachComponent(gltf, a, [&](size_t i, size_t component, const uint8_t* from) {
        const float value = loadFloat(from, a.componentType, a.normalized);
        if (!std::isfinite(value)) fault(element("accessors", accessor), ": element ", i, " is not finite");
        values[i * components + component] = value;
    });
    return values;
}

std::vector<uint32_t> readIntegers(const tinygltf::Model& gltf, int accessor) {
    const tinygltf::Accessor& a = gltf.accessors[static_cast<size_t>(accessor)];
    const auto components = static_cast<size_t>(componentCount(a));
    const size_t bytes = componentBytes(a.componentType);
    std::vector<uint32_t> values(a.count * components);
    forEachComponent(gltf, a, [&](size_t i, size_t component, const uint8_t* from) {
        values[i * components + component] = loadUnsigned(from, bytes);
    });
    return values;
}

} // namespace shoal::scene
