#include "engine/occlusion/gpu/Storage.h"

#include <algorithm>
#include <string>

namespace shoal::occlusion {

Status canKeepLayers() {
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 43)
        return Error{"", "layers need OpenGL 4.3; this is " + std::to_string(version / 10) + "." +
                             std::to_string(version % 10)};
    GLint blocks = 0;
    glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
    constexpr GLint kBlocks = 6; // shaders/occlusion/Bindings.glsl
    if (blocks < kBlocks)
        return Error{"", "layers need " + std::to_string(kBlocks) +
                             " storage buffers in a fragment shader; there are " + std::to_string(blocks)};
    return Done{};
}

Result<gl::Buffer> storageBuffer(const void* data, size_t bytes) {
    GLint64 maximum = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &maximum);
    if (bytes > static_cast<size_t>(maximum))
        return Error{"", "a storage buffer of " + std::to_string(bytes) +
                             " bytes is too large here; at most " + std::to_string(maximum)};
    while (glGetError() != GL_NO_ERROR) {
    }
    gl::Buffer buffer = gl::Buffer::make();
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
    // A shader that names an empty block must find something there.
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(std::max<size_t>(bytes, 16)),
                 bytes >= 16 ? data : nullptr, GL_STATIC_DRAW);
    if (bytes < 16 || !data)
        glClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    if (data && bytes && bytes < 16)
        glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
    if (glGetError() == GL_OUT_OF_MEMORY)
        return Error{"",
                     "the graphics driver has no memory for " + std::to_string(bytes) + " bytes of layers"};
    return buffer;
}

} // namespace shoal::occlusion
