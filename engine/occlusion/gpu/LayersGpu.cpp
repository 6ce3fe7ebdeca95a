#include "engine/occlusion/gpu/LayersGpu.h"

#include "shaders/occlusion/Bindings.glsl"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace shoal::occlusion {

namespace {

// Distance from a ray's origin, pixels, within which hits are ignored, so that a ray does not hit the surface
// that it leaves: the values with the smallest error in tests/bench/occlusion.
constexpr float kStartOllfb_px = 0.32f, kStartThesis_px = 3;

float startOf(float start_px, const Sphere& sphere, int resolution) {
    return start_px * 2 * sphere.radius / static_cast<float>(resolution);
}

// Ollfb.glsl reads the buffers of an Ollfb as they are, std430.
static_assert(sizeof(OllfbView) == 68, "17 words in the order of the members");
static_assert(sizeof(OllfbRow) == 12, "three words, begin in the low half of the third");

} // namespace

Status canKeepLayers() {
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 43)
        return Error{"", fmt::format("layers need OpenGL 4.3; this is {}.{}", version / 10, version % 10)};
    GLint blocks = 0;
    glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
    constexpr GLint kBlocks = 6; // shaders/occlusion/Bindings.glsl
    if (blocks < kBlocks)
        return Error{"", fmt::format("layers need {} storage buffers in a fragment shader; there are {}",
                                     kBlocks, blocks)};
    return Done{};
}

Result<gl::Buffer> storageBuffer(const void* data, size_t bytes) {
    GLint64 maximum = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &maximum);
    if (bytes > static_cast<size_t>(maximum))
        return Error{
            "", fmt::format("a storage buffer of {} bytes is too large here; at most {}", bytes, maximum)};
    while (glGetError() != GL_NO_ERROR) {
    }
    gl::Buffer buffer = gl::Buffer::make();
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
    // The size is a multiple of 4 and never 0, because a buffer that a shader declares must exist.
    const size_t size = std::max<size_t>((bytes + 3) / 4 * 4, 16);
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(size), nullptr, GL_STATIC_DRAW);
    glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
    if (glGetError() == GL_OUT_OF_MEMORY)
        return Error{"", fmt::format("the graphics driver has no memory for {} bytes of layers", bytes)};
    return buffer;
}

Result<LayersGpu> LayersGpu::make(const BodyMesh& mesh, LayerMethod method, const Ollfb::Options& options) {
    if (Status status = canKeepLayers(); !status) return status.error();
    for (const glm::vec3& position : mesh.positions) // a file's large scales may multiply
        if (!std::isfinite(glm::dot(position, position))) return Error{"", "the body is infinitely large"};
    if (method == LayerMethod::Thesis) {
        const auto made = ThesisLayers::make(
            mesh, {.cells = *ThesisViews::cellsFor(options.views), .resolution = options.resolution});
        return made ? upload(*made) : made.error();
    }
    const auto made = Ollfb::make(mesh, options);
    if (!made) return made.error();
    auto layers = upload(*made);
    if (layers) layers->nearest_m_ = startOf(kStartOllfb_px, made->sphere, options.resolution);
    return layers;
}

template <class T> Status LayersGpu::keep(int binding, const std::vector<T>& values) {
    auto buffer = storageBuffer(values.data(), values.size() * sizeof(T));
    if (!buffer) return buffer.error();
    buffers_.emplace_back(static_cast<GLuint>(binding), std::move(*buffer));
    return Done{};
}

Result<LayersGpu> LayersGpu::upload(const Ollfb& ollfb) {
    LayersGpu result;
    result.closed_ = ollfb.closed;
    for (const Status& status :
         {result.keep(OCCLUSION_VIEWS, ollfb.views), result.keep(OCCLUSION_ROWS, ollfb.rows),
          result.keep(OCCLUSION_STARTS, ollfb.starts), result.keep(OCCLUSION_LAYERS, ollfb.layers),
          result.keep(OCCLUSION_AXES, ollfb.axes.table)})
        if (!status) return status.error();
    return result;
}

Result<LayersGpu> LayersGpu::upload(const ThesisLayers& layers) {
    LayersGpu result;
    result.method_ = LayerMethod::Thesis;
    result.views_ = layers.views;
    result.nearest_m_ = startOf(kStartThesis_px, layers.views.sphere, layers.views.resolution);
    for (const Status& status :
         {result.keep(OCCLUSION_STARTS, layers.starts), result.keep(OCCLUSION_LAYERS, layers.layers)})
        if (!status) return status.error();
    return result;
}

void LayersGpu::bind(const gl::Program& program) const {
    program.set("layersNearest", nearest_m_);
    if (method_ == LayerMethod::Thesis) {
        program.set("cells", views_.cells);
        program.set("resolution", views_.resolution);
        program.set("sphere", glm::vec4(views_.sphere.centre, views_.sphere.radius));
        program.set("pixelsPerMetre", views_.pixelsPerMetre());
    } else {
        program.set("closed", closed_ ? 1 : 0);
    }
    for (const auto& [binding, buffer] : buffers_)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

} // namespace shoal::occlusion
