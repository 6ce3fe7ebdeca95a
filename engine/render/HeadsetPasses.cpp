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

} // namespace shoal::render
