// Shader storage buffers (OpenGL 4.3): creation, and reading back.
#pragma once

#include "engine/core/Result.h"
#include "engine/gl/Objects.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::occlusion {

inline constexpr int kStorageGlsl = 430;

// Whether the current context can keep layers: OpenGL 4.3, with storage buffers and atomics in fragment
// shaders. The error says what it has.
Status canKeepLayers();

// A storage buffer of `bytes`, filled from `data` or, if null, with zeros. The error says that the driver has
// not the memory.
Result<gl::Buffer> storageBuffer(const void* data, size_t bytes);

template <class T> Result<gl::Buffer> storageBuffer(std::span<const T> values) {
    return storageBuffer(values.data(), values.size_bytes());
}

// Of the first `count` values; waits for what writes them.
template <class T> std::vector<T> readStorage(const gl::Buffer& buffer, size_t count) {
    std::vector<T> values(count);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(T)),
                       values.data());
    return values;
}

} // namespace shoal::occlusion
