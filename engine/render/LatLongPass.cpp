#include "engine/render/LatLongPass.h"

#include <array>
#include <cassert>
#include <cmath>

namespace shoal::render {

namespace {

constexpr std::array<const char*, 3> kDefines = {"FILMED", "GRAINY", "SHARES_COLOUR"}; // as FilmedFeature

void attach(const gl::Framebuffer& framebuffer, GLuint texture) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    assert(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

} // namespace

View widened(const View& view, float factor) {
    View wide = view;
    wide.verticalFov = 2 * std::atan(factor * std::tan(view.verticalFov / 2));
    return wide;
}

Result<LatLongPass> LatLongPass::make() {
    LatLongPass pass;
    pass.programs_ = gl::Variants("render/LatLong", kDefines);
    // Compiled now, so that a broken shader is known at the start.
    for (const unsigned features : {0u, static_cast<unsigned>(kFilmed)})
        if (auto program = pass.programs_.get(features); !program) return program.error();
    pass.drawn_ = Corners::make();
    pass.frameBuffer_ = gl::Framebuffer::make();
    pass.keptBuffer_ = gl::Framebuffer::make();
    return pass;
}

void LatLongPass::copy(GLuint from, GLuint to) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    for (const Run& r : runs_)
        glBlitFramebuffer(r.x, r.y, r.x + r.width, r.y + r.height, r.x, r.y, r.x + r.width, r.y + r.height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void LatLongPass::restore(const SurroundGpu& surround) {
    if (paintedFrame_ != 0 && paintedFrame_ == surround.frameNumber())
        copy(keptBuffer_.name(), frameBuffer_.name());
    paintedFrame_ = 0;
}

Status LatLongPass::paint(const SurroundGpu& surround, const FrameTiles& tiles, GLuint layer,
                          const View& layerView, const glm::mat3& envFromWorld, const Filmed* filmed) {
    assert(surround.frameIsCoded());
    restore(surround);
    const glm::ivec2 size(surround.frameWidth(), surround.frameHeight());
    assert(size == tiles.frameSize());
    if (size != keptSize_) {
        keptSize_ = size;
        kept_ = gl::Texture::make();
        glBindTexture(GL_TEXTURE_2D, kept_.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size.x, size.y, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        attach(keptBuffer_, kept_.name());
    }

    runs_.clear();
    corners_.clear();
    eachRun(tiles.chosen(), FrameTiles::kCount, [&](int first, int end, int row) {
        const glm::ivec2 low = tiles.lowOf({first, row}), high = tiles.lowOf({end, row + 1});
        if (low.x == high.x || low.y == high.y) return;
        runs_.push_back({low.x, low.y, high.x - low.x, high.y - low.y});
        for (int tile = first; tile < end; ++tile) {
            const glm::vec2 left = tiles.lowOf({tile, row}), right = tiles.lowOf({tile + 1, row + 1});
            if (left.x < right.x) addRectangle(left / glm::vec2(size), right / glm::vec2(size), corners_);
        }
    });
    if (runs_.empty()) return Done{};
    attach(frameBuffer_, surround.frameTexture());
    copy(frameBuffer_.name(), keptBuffer_.name());
    paintedFrame_ = surround.frameNumber();

    auto found = programs_.get(filmed ? filmedFeatures(filmed->look) : 0);
    if (!found) return found.error();
    const gl::Program& program = **found;
    glBindFramebuffer(GL_FRAMEBUFFER, frameBuffer_.name());
    glViewport(0, 0, size.x, size.y);
    program.use();
    if (filmed) {
        if (!grain_) grain_ = makeGrainTexture();
        setFilmed(program, *filmed);
        surround.bindScattered(program, 1);
        glActiveTexture(GL_TEXTURE2);
        glBindTexture(GL_TEXTURE_2D, kept_.name());
        program.set("kept", 2);
        glActiveTexture(GL_TEXTURE3);
        glBindTexture(GL_TEXTURE_2D, grain_.name());
        program.set("grain", 3);
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, layer);
    program.set("layer", 0);
    program.set("eyeFromEnv", glm::transpose(envFromWorld * glm::mat3_cast(layerView.worldFromEye)));
    program.set("rayScale", layerView.halfExtent());
    program.set("rayShift", layerView.shift);
    if (filmed)
        drawn_.draw(corners_); // mixes by itself
    else
        drawn_.drawOver(corners_);
    return Done{};
}

} // namespace shoal::render
