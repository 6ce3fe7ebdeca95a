#include "engine/gl/Target.h"

#include <algorithm>
#include <cassert>

namespace shoal::gl {

Target::Target(int width, int height, int samples) : width_(width), height_(height) {
    GLint maximum = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &maximum);
    samples_ = std::clamp(samples, 1, std::max(1, maximum));
    // The texture that is read in the end; without multisampling it is drawn into directly. Blue first in
    // memory, as in windows, which Mesa grants only if the internal format is unsized; other orders are
    // copied more slowly.
    texture_ = makeTexture(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
    if (samples_ > 1) makeStorage(samplesColour_, GL_RGBA8);

    // sampled: whether it is drawn into with all samples.
    const auto makeFramebuffer = [&](Framebuffer& buffer, bool sampled) {
        buffer = Framebuffer::make();
        glBindFramebuffer(GL_FRAMEBUFFER, buffer.name());
        if (sampled && samples_ > 1)
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                      samplesColour_.name());
        else
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    };
    makeFramebuffer(resolved_, false);
    makeFramebuffer(colourOnly_, true);
    makeFramebuffer(drawn_, true);
}

void Target::makeStorage(Renderbuffer& buffer, GLenum format) const {
    buffer = Renderbuffer::make();
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_ > 1 ? samples_ : 0, format, width_, height_);
}

void Target::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    glViewport(0, 0, width_, height_);
    if (depth_) return;
    makeStorage(depth_, GL_DEPTH_COMPONENT24);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    assert(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void Target::bindColour() const {
    glBindFramebuffer(GL_FRAMEBUFFER, colourOnly_.name());
    glViewport(0, 0, width_, height_);
}

void Target::resolve() const {
    if (samples_ == 1) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Target::blitTo(GLuint destination, int x, int width, int height) const {
    const bool scales = width != width_ || height != height_;
    if (scales) resolve(); // a resolve may not scale
    glBindFramebuffer(GL_READ_FRAMEBUFFER, (scales ? resolved_ : drawn_).name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, destination);
    glBlitFramebuffer(0, 0, width_, height_, x, 0, x + width, height, GL_COLOR_BUFFER_BIT,
                      scales ? GL_LINEAR : GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, destination);
}

void Target::readBgra(std::vector<uint32_t>& pixels) const {
    pixels.resize(static_cast<size_t>(width_) * static_cast<size_t>(height_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
    glReadPixels(0, 0, width_, height_, GL_BGRA, GL_UNSIGNED_BYTE, pixels.data());
}

ImageRgba8 Target::read() const {
    resolve();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
    ImageRgba8 image(width_, height_);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
    const size_t row = static_cast<size_t>(width_) * 4;
    for (int y = 0; y < height_ / 2; ++y)
        std::swap_ranges(image.at(0, y), image.at(0, y) + row, image.at(0, height_ - 1 - y));
    return image;
}

} // namespace shoal::gl
