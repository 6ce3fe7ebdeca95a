#include "engine/render/BackdropPass.h"

namespace shoal::render {

Result<BackdropPass> BackdropPass::make() {
    auto program = gl::Program::load("render/Backdrop");
    if (!program) return program.error();
    BackdropPass pass;
    pass.program_ = std::move(*program);
    pass.nothing_ = gl::VertexArray::make();
    return pass;
}

void BackdropPass::draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                        const Exposure& exposure) const {
    program_.use();
    surround.bindFrame(program_);
    program_.set("worldFromRay", envFromWorld * glm::mat3_cast(view.worldFromEye));
    program_.set("rayScale", view.halfExtent());
    program_.set("rayShift", view.shift);
    program_.set("lod", 0.0f);
    program_.set("toneCurve", static_cast<int>(exposure.curve));
    program_.set("exposureScale", exposure.scale());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
}

} // namespace shoal::render
