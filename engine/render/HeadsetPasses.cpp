#include "engine/render/HeadsetPasses.h"

#include <algorithm>

namespace shoal::render {

Result<HeadsetPasses> HeadsetPasses::make() {
    HeadsetPasses passes;
    if (Status s = gl::Program::load("render/Fade").moveTo(passes.fade_); !s) return s.error();
    if (Status s = gl::Program::load("render/Premultiply").moveTo(passes.premultiply_); !s) return s.error();
    return passes;
}

void HeadsetPasses::fade(const glm::vec4& colour, float amount) const {
    if (!(amount > 0)) return;
    fade_.use();
    fade_.set("colour", colour);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendColor(0, 0, 0, std::min(amount, 1.0f));
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    picture_.draw();
    glDisable(GL_BLEND);
}

void HeadsetPasses::premultiply(const gl::Target& from, GLuint into) const {
    from.resolve();
    glBindFramebuffer(GL_FRAMEBUFFER, into);
    glViewport(0, 0, from.width(), from.height());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    premultiply_.use();
    premultiply_.setTexture("picture", 0, from.texture());
    picture_.draw();
}

Result<DepthPass> DepthPass::make() {
    DepthPass pass;
    if (Status s = gl::Program::load("render/Depth").moveTo(pass.plain_); !s) return s.error();
    if (Status s = gl::Program::load("render/Depth", {"FILM"}).moveTo(pass.filmed_); !s) return s.error();
    pass.copyTarget_ = gl::Framebuffer::make();
    return pass;
}

void DepthPass::draw(const gl::Target& from, float part, GLuint into, const EyePicture& picture, bool film) {
    const glm::ivec2 fromSize(from.width(), from.height());
    glBindFramebuffer(GL_FRAMEBUFFER, copyTarget_.name());
    if (copySize_ != fromSize) {
        copySize_ = fromSize;
        copy_ = gl::makeTexture(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
        // The copy has the target's own format, because depth is copied between equal formats only.
        glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, fromSize.x, fromSize.y, 0, GL_DEPTH_COMPONENT,
                     GL_UNSIGNED_INT, nullptr);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, copy_.name(), 0);
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer());
    glBlitFramebuffer(0, 0, fromSize.x, fromSize.y, 0, 0, fromSize.x, fromSize.y, GL_DEPTH_BUFFER_BIT,
                      GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, into);
    glViewport(0, 0, picture.size().x, picture.size().y);
    const gl::Program& program = film ? filmed_ : plain_;
    program.use();
    program.setTexture("depth", 0, copy_.name());
    program.set("part", part);
    if (film) {
        picture.environment.bindDepth(program, picture.eyeInFilm);
        program.set("envFromEye", picture.envFromEye());
        program.set("rayScale", picture.view.halfExtent());
        program.set("rayShift", picture.view.shift);
        program.set("planes", glm::vec2(picture.view.near_m, picture.view.far_m));
    }
    glEnable(GL_DEPTH_TEST); // depth is written only while it is tested
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    picture_.draw();
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

} // namespace shoal::render
