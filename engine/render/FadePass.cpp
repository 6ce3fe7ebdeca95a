#include "engine/render/FadePass.h"

#include <algorithm>

namespace shoal::render {

Result<FadePass> FadePass::make() {
    FadePass pass;
    if (Status s = gl::Program::load("render/Fade").moveTo(pass.program_); !s) return s.error();
    pass.drawn_ = TriangleBatch::make();
    return pass;
}

void FadePass::draw(const glm::vec4& colour, float amount) {
    if (!(amount > 0)) return;
    static const std::vector<glm::vec2> kAll = {{-1, -1}, {3, -1}, {-1, 3}};
    program_.use();
    program_.set("colour", colour);
    glEnable(GL_BLEND);
    glBlendColor(0, 0, 0, std::min(amount, 1.0f));
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    drawn_.draw(kAll);
    glDisable(GL_BLEND);
}

} // namespace shoal::render
