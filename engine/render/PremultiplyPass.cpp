#include "engine/render/PremultiplyPass.h"

namespace shoal::render {

Result<PremultiplyPass> PremultiplyPass::make() {
    PremultiplyPass pass;
    if (Status s = gl::Program::load("render/Premultiply").moveTo(pass.program_); !s) return s.error();
    return pass;
}

void PremultiplyPass::draw(const gl::Target& from, GLuint into) {
    from.resolve();
    glBindFramebuffer(GL_FRAMEBUFFER, into);
    glViewport(0, 0, from.width(), from.height());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    program_.use();
    program_.setTexture("picture", 0, from.texture());
    picture_.draw();
}

} // namespace shoal::render
