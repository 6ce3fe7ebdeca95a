#include "engine/render/FadePass.h"

#include <algorithm>

namespace shoal::render {

Result<FadePass> FadePass::make() {
    FadePass pass;
    if (Status s = gl::Program::load("render/Fade").moveTo(pass.program_); !s) return s.error();
    return pass;
}

void FadePass::draw(const glm::vec4& colour, float amount) {
    if (!(amount > 0)) return;
    program_.use();
    program_.set("colour", colour);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendColor(0, 0, 0, std::min(amount, 1.0f));
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    picture_.draw();
    glDisable(GL_BLEND);
}

} // namespace shoal::render
