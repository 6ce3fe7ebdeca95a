#include "tests/gl/occlusion/TracePass.h"

#include "engine/occlusion/gpu/LayersGpu.h"
#include "engine/render/TriangleBatch.h"
#include "shaders/occlusion/Bindings.glsl"

#include <algorithm>

namespace shoal::occlusion {

namespace {

Result<TracePass::Answers> run(const gl::Program& program, const LayersGpu& layers,
                               std::span<const RayGpu> rays) {
    constexpr int kWidth = 256;
    const int count = static_cast<int>(rays.size());
    const int height = std::max(1, (count + kWidth - 1) / kWidth);
    auto asked = storageBuffer(rays.data(), rays.size_bytes());
    if (!asked) return asked.error();
    const gl::Texture answers = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, answers.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kWidth, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    const gl::Framebuffer picture = gl::Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, picture.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answers.name(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return Error{"", "a picture of floats cannot be drawn into here"};
    glViewport(0, 0, kWidth, height);
    glDisable(GL_DEPTH_TEST), glDisable(GL_BLEND), glDisable(GL_SCISSOR_TEST);
    program.use();
    layers.bind(program);
    program.set("width", kWidth);
    program.set("rayCount", count);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, OCCLUSION_RAYS, asked->name());
    render::WholePicture().draw();
    std::vector<glm::vec4> pixels(static_cast<size_t>(kWidth) * static_cast<size_t>(height));
    glReadPixels(0, 0, kWidth, height, GL_RGBA, GL_FLOAT, pixels.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    TracePass::Answers hits(rays.size());
    for (size_t i = 0; i < hits.size(); ++i)
        if (pixels[i].x >= 0) hits[i] = Hit{pixels[i].x, glm::vec3(pixels[i].y, pixels[i].z, pixels[i].w)};
    return hits;
}

} // namespace

Result<TracePass> TracePass::make() {
    if (Status status = canKeepLayers(); !status) return status.error();
    TracePass pass;
    auto thesis = gl::Program::load("../tests/gl/occlusion/Trace", {"THESIS"}, kStorageGlsl);
    if (!thesis) return thesis.error();
    auto cured = gl::Program::load("../tests/gl/occlusion/Trace", {}, kStorageGlsl);
    if (!cured) return cured.error();
    pass.thesis_ = std::move(*thesis);
    pass.cured_ = std::move(*cured);
    return pass;
}

Result<TracePass::Answers> TracePass::trace(const LayersGpu& layers, std::span<const RayGpu> rays) const {
    return run(layers.method() == LayerMethod::Thesis ? thesis_ : cured_, layers, rays);
}

} // namespace shoal::occlusion
