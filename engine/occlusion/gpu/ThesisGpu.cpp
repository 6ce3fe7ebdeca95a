#include "engine/occlusion/gpu/ThesisGpu.h"

#include "engine/occlusion/gpu/Storage.h"
#include "shaders/occlusion/Bindings.glsl"

#include <cmath>
#include <numeric>
#include <string>

namespace shoal::occlusion {

namespace {

// Positions and normals side by side, and triangles.
struct MeshGpu {
    gl::VertexArray array = gl::VertexArray::make();
    gl::Buffer vertices = gl::Buffer::make(), indices = gl::Buffer::make();

    explicit MeshGpu(const BodyMesh& mesh) {
        glBindVertexArray(array.name());
        glBindBuffer(GL_ARRAY_BUFFER, vertices.name());
        const auto bytes = static_cast<GLsizeiptr>(mesh.positions.size_bytes());
        glBufferData(GL_ARRAY_BUFFER, 2 * bytes, nullptr, GL_STREAM_DRAW);
        glBufferSubData(GL_ARRAY_BUFFER, 0, bytes, mesh.positions.data());
        glBufferSubData(GL_ARRAY_BUFFER, bytes, bytes, mesh.normals.data());
        for (const GLuint k : {0u, 1u}) {
            glVertexAttribPointer(k, 3, GL_FLOAT, GL_FALSE, 0,
                                  reinterpret_cast<const void*>(k * mesh.positions.size_bytes()));
            glEnableVertexAttribArray(k);
        }
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.triangles.size_bytes()),
                     mesh.triangles.data(), GL_STREAM_DRAW);
    }
};

void setViews(const gl::Program& program, const ThesisViews& views) {
    program.set("cells", views.cells);
    program.set("resolution", views.resolution);
    program.set("sphere", glm::vec4(views.sphere.centre, views.sphere.radius));
    program.set("pixelsPerMetre", views.pixelsPerMetre());
}

} // namespace

Result<ThesisGpu> ThesisGpu::see(const BodyMesh& mesh, const ThesisOptions& options) {
    if (Status status = canKeepLayers(); !status) return status.error();
    if (Status status = checkMesh(mesh); !status) return status.error();
    if (Status status = checkOptions(options); !status) return status.error();
    auto count = gl::Program::load("occlusion/See", {"COUNT"}, kStorageGlsl);
    if (!count) return count.error();
    auto fill = gl::Program::load("occlusion/See", {}, kStorageGlsl);
    if (!fill) return fill.error();
    auto sort = gl::Program::load("occlusion/Sort", {}, kStorageGlsl);
    if (!sort) return sort.error();

    ThesisGpu result;
    result.views_ = {options.cells, options.resolution, boundingSphere(mesh)};
    const ThesisViews& views = result.views_;
    const size_t pixels =
        static_cast<size_t>(views.count()) * static_cast<size_t>(views.resolution * views.resolution);
    const Error tooLarge{"", "a body's layers would take more than " + std::to_string(options.maxBytes) +
                                 " bytes; see it from fewer sides or with fewer pixels"};
    result.startCount_ = pixels + 1;
    if (result.bytes() > options.maxBytes) return tooLarge;

    // All views side by side in a picture that has no memory.
    const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(views.count()))));
    const int rows = (views.count() + columns - 1) / columns;
    const glm::ivec2 size = glm::ivec2(columns, rows) * views.resolution;
    GLint widest = 0;
    glGetIntegerv(GL_MAX_FRAMEBUFFER_WIDTH, &widest);
    if (std::max(size.x, size.y) > widest)
        return Error{"", "all views side by side are wider than the " + std::to_string(widest) +
                             " pixels possible here"};
    const gl::Framebuffer picture = gl::Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, picture.name());
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, size.x);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, size.y);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST), glDisable(GL_CULL_FACE), glDisable(GL_BLEND), glDisable(GL_SCISSOR_TEST);
    const MeshGpu drawn(mesh);
    const auto draw = [&](const gl::Program& program) {
        program.use();
        setViews(program, views);
        program.set("columns", columns);
        program.set("pictureSize", glm::vec2(size));
        glBindVertexArray(drawn.array.name());
        glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(3 * mesh.triangles.size()),
                                GL_UNSIGNED_INT, nullptr, views.count());
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    };

    auto starts = storageBuffer(nullptr, result.startCount_ * sizeof(uint32_t));
    if (!starts) return starts.error();
    result.starts_ = std::move(*starts);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, OCCLUSION_STARTS, result.starts_.name());
    draw(*count);
    const std::vector<uint32_t> counts = result.readStarts();
    uint64_t total = 0;
    std::vector<uint32_t> offsets;
    offsets.reserve(counts.size());
    for (const uint32_t each : counts) {
        offsets.push_back(static_cast<uint32_t>(total));
        total += each;
        if (total * sizeof(ThesisLayer) > options.maxBytes) return tooLarge;
    }
    result.layerCount_ = total;
    auto layers = storageBuffer(nullptr, total * sizeof(ThesisLayer));
    if (!layers) return layers.error();
    result.layers_ = std::move(*layers);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, OCCLUSION_LAYERS, result.layers_.name());
    const auto setStarts = [&] {
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, result.starts_.name());
        glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0,
                        static_cast<GLsizeiptr>(offsets.size() * sizeof(uint32_t)), offsets.data());
    };
    setStarts();
    draw(*fill);
    setStarts();
    sort->use();
    setViews(*sort, views);
    sort->set("columns", columns);
    sort->set("views", views.count());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glBindVertexArray(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return result;
}

void ThesisGpu::bind(const gl::Program& program) const {
    setViews(program, views_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, OCCLUSION_STARTS, starts_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, OCCLUSION_LAYERS, layers_.name());
}

std::vector<uint32_t> ThesisGpu::readStarts() const { return readStorage<uint32_t>(starts_, startCount_); }
std::vector<ThesisLayer> ThesisGpu::readLayers() const {
    return readStorage<ThesisLayer>(layers_, layerCount_);
}

} // namespace shoal::occlusion
