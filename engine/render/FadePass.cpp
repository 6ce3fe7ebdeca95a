#include "engine/render/FadePass.h"

#include <algorithm>
#include <array>

namespace shoal::render {

Result<FadePass> FadePass::make() {
    FadePass pass;
    if (Status s = gl::Program::load("render/Fade").moveTo(pass.program_); !s) return s.error();
    pass.drawn_ = TriangleBatch::make();
    return pass;
}

void FadePass::draw(std::span<const glm::vec2> corners, const glm::vec2& halfExtent, const glm::vec2& shift,
                    const glm::vec4& colour) {
    program_.use();
    program_.set("halfExtent", halfExtent);
    program_.set("shift", shift);
    program_.set("colour", colour);
    drawn_.draw(corners);
}

void FadePass::hide(std::span<const glm::vec2> corners, const View& view) {
    glDisable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    glStencilMask(0xff);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    if (corners.empty()) return;
    glDisable(GL_BLEND);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    draw(corners, view.halfExtent(), view.shift, glm::vec4(0, 0, 0, 1));
    glDisable(GL_STENCIL_TEST);
}

FadePass::OnlySeen::OnlySeen() {
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_EQUAL, 0, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}
FadePass::OnlySeen::~OnlySeen() { glDisable(GL_STENCIL_TEST); }

void FadePass::fade(const glm::vec3& colour, float amount) {
    if (!(amount > 0)) return;
    static constexpr std::array<glm::vec2, 3> kAll = {glm::vec2(-1, -1), glm::vec2(3, -1), glm::vec2(-1, 3)};
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw(kAll, glm::vec2(1), glm::vec2(0), glm::vec4(colour, std::min(amount, 1.0f)));
    glDisable(GL_BLEND);
}

} // namespace shoal::render
