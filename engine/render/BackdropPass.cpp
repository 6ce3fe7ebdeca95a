#include "engine/render/BackdropPass.h"

#include "engine/gl/Renderer.h"
#include "shaders/render/Attributes.glsl"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <thread>

namespace shoal::render {

namespace {

enum FeatureBit : unsigned {
    kPolarBit = 1u << 0,
    kAsIs = 1u << 1,
    kFrameIsCoded = 1u << 2,
    kAces = 1u << 3,
    kLinear = 1u << 4,
};
constexpr std::array<const char*, 5> kDefines = {"POLAR", "AS_IS", "FRAME_IS_CODED", "TONE_ACES",
                                                 "TONE_LINEAR"};

unsigned featuresOf(const SurroundGpu& surround, const Exposure& exposure) {
    const bool inverse = exposure.curve == ToneCurve::InverseOfVideo;
    if (surround.frameIsCoded() && inverse && exposure.scale() == 1.0f) return kAsIs;
    return (surround.frameIsCoded() ? kFrameIsCoded : 0u) | (exposure.curve == ToneCurve::Aces     ? kAces
                                                             : exposure.curve == ToneCurve::Linear ? kLinear
                                                                                                   : 0u);
}

// What the bound framebuffer's colours are, if all of a texture's.
GLuint drawnTexture() {
    GLint type = GL_NONE, name = 0, bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    if (bound == 0 || glIsEnabled(GL_STENCIL_TEST)) return 0;
    const auto ask = [](GLenum what, GLint& answer) {
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, what, &answer);
    };
    ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, type);
    if (type == GL_TEXTURE) ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, name);
    return static_cast<GLuint>(name);
}

glm::ivec2 viewportSize() {
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    return {viewport[2], viewport[3]};
}

} // namespace

Result<BackdropPass> BackdropPass::make() {
    BackdropPass pass;
    pass.programs_ = gl::Variants("render/Backdrop", kDefines);
    if (gl::rendersInSoftware() && canSampleFrames())
        pass.sampler_.emplace(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 4) - 1);
    pass.vertexArray_ = gl::VertexArray::make();
    pass.vertices_ = gl::Buffer::make();
    pass.indices_ = gl::Buffer::make();
    glBindVertexArray(pass.vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, pass.vertices_.name());
    const auto attribute = [](GLuint location, size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, 2, GL_FLOAT, GL_FALSE, sizeof(Corner),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(ATTRIBUTE_POSITION, offsetof(Corner, place));
    attribute(ATTRIBUTE_UV0, offsetof(Corner, uv));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, pass.indices_.name());
    glBindVertexArray(0);
    // Compiled now, so that a broken shader is known at the start.
    for (const unsigned features : {0u, static_cast<unsigned>(kPolarBit)})
        if (auto program = pass.programs_.get(kAsIs | features); !program) return program.error();
    return pass;
}

bool BackdropPass::canDrawFromMemory(const SurroundGpu& surround, const Exposure& exposure) const {
    return sampler_ && featuresOf(surround, exposure) == kAsIs && drawnTexture() != 0;
}

void BackdropPass::begin(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                         const Exposure& exposure, const glm::ivec2& size, const InMemory& inMemory) {
    if (!sampler_ || featuresOf(surround, exposure) != kAsIs) return;
    sampler_->start({inMemory.frame, surround.frameNumber(), inMemory.tiles, view,
                     envFromWorld * glm::mat3_cast(view.worldFromEye), size});
}

void BackdropPass::clearCorners() {
    for (std::vector<Corner>& each : corners_) each.clear();
}

void BackdropPass::addCorners(const BackdropCell& cell, bool painted, const glm::ivec2& size) {
    std::vector<Corner>& to = corners_[(cell.polar ? kPolar : kPlain) + (painted ? kPaintedPlain : kPlain)];
    for (int i = 0; i < 4; ++i) {
        const glm::ivec2 at(i & 1 ? cell.high.x : cell.low.x, i >> 1 ? cell.high.y : cell.low.y);
        to.push_back(
            {2.0f * glm::vec2(at) / glm::vec2(size) - 1.0f,
             cell.first + static_cast<float>(i & 1) * cell.right + static_cast<float>(i >> 1) * cell.up});
    }
}

Status BackdropPass::draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                          const Exposure& exposure) {
    const glm::mat3 envFromRay = envFromWorld * glm::mat3_cast(view.worldFromEye);
    const glm::ivec2 size = viewportSize();
    cells_.make(view, envFromRay, size);
    clearCorners();
    for (const BackdropCell& cell : cells_.all()) addCorners(cell, false, size);
    return drawCorners(surround, view, envFromRay, exposure);
}

Status BackdropPass::drawFromMemory(const SurroundGpu& surround, const View& view,
                                    const glm::mat3& envFromWorld, const InMemory& inMemory,
                                    const TexelPaint* paint) {
    const glm::ivec2 size = viewportSize();
    if (!sampler_->started()) begin(surround, view, envFromWorld, {}, size, inMemory);
    sampler_->finish(paint);
    if (sampler_->sampledAny()) putPicture(drawnTexture(), size);
    clearCorners();
    for (const auto& [cell, painted] : sampler_->left()) addCorners(*cell, painted, size);
    if (!corners_[kPaintedPlain].empty() || !corners_[kPaintedPolar].empty())
        putPainted(sampler_->painted().frame());
    return drawCorners(surround, view, envFromWorld * glm::mat3_cast(view.worldFromEye), {});
}

void BackdropPass::putPicture(GLuint texture, const glm::ivec2& size) const {
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_BGRA, GL_UNSIGNED_BYTE, sampler_->picture());
}

// Only the runs that hold anything.
void BackdropPass::putPainted(const CodedFrame& frame) {
    const glm::ivec2 size(frame.width, frame.height);
    if (size != paintedSize_) {
        paintedSize_ = size;
        painted_ = makeLatLongTexture();
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size.x, size.y, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
    }
    glBindTexture(GL_TEXTURE_2D, painted_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, frame.rowPixels);
    const auto* texels = reinterpret_cast<const uint32_t*>(frame.pixels);
    for (const PaintedFrame::Run& run : sampler_->painted().runs())
        glTexSubImage2D(GL_TEXTURE_2D, 0, run.low.x, run.low.y, run.high.x - run.low.x,
                        run.high.y - run.low.y, GL_BGRA, GL_UNSIGNED_BYTE,
                        texels + ptrdiff_t{run.low.y} * frame.rowPixels + run.low.x);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

Status BackdropPass::drawCorners(const SurroundGpu& surround, const View& view, const glm::mat3& envFromRay,
                                 const Exposure& exposure) {
    size_t all = 0;
    for (const std::vector<Corner>& each : corners_) all += each.size() / 4;
    if (all == 0) return Done{};
    glBindVertexArray(vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * all * sizeof(Corner)), nullptr, GL_STREAM_DRAW);
    GLintptr put = 0;
    for (const std::vector<Corner>& each : corners_) {
        const auto bytes = static_cast<GLsizeiptr>(each.size() * sizeof(Corner));
        glBufferSubData(GL_ARRAY_BUFFER, put, bytes, each.data());
        put += bytes;
    }
    if (indexedCells_ < all) {
        std::vector<uint32_t> indices;
        for (uint32_t first = 0; first < 4 * all; first += 4)
            for (const uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + corner);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)),
                     indices.data(), GL_STATIC_DRAW);
        indexedCells_ = all;
    }

    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    size_t first = 0;
    for (size_t kind = 0; kind < kKinds; ++kind) {
        const size_t count = corners_[kind].size() / 4;
        if (count == 0) continue;
        auto found = programs_.get(featuresOf(surround, exposure) | (kind % 2 ? kPolarBit : 0u));
        if (!found) return found.error();
        const gl::Program& program = **found;
        program.use();
        const GLuint frame = kind >= kPaintedPlain ? painted_.name() : surround.frameTexture();
        glActiveTexture(GL_TEXTURE0 + UNIT_FRAME);
        glBindTexture(GL_TEXTURE_2D, frame);
        program.set("frame", UNIT_FRAME);
        program.set("envFromRay", envFromRay);
        program.set("rayScale", view.halfExtent());
        program.set("rayShift", view.shift);
        program.set("exposureScale", exposure.scale());
        // Few at a time: llvmpipe cuts longer draws between the triangles of a rectangle.
        constexpr size_t kAtOnce = 160;
        for (size_t done = 0; done < count; done += kAtOnce)
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * std::min(kAtOnce, count - done)),
                           GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(6 * (first + done) * sizeof(uint32_t)));
        first += count;
    }
    glBindVertexArray(0);
    return Done{};
}

} // namespace shoal::render
