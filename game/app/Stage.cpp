#include "game/app/Stage.h"

namespace shoal::app {

Result<Stage> Stage::make(Cast cast, render::Detail detail) {
    auto backdrop = render::BackdropPass::make();
    if (!backdrop) return backdrop.error();
    auto objects = render::ObjectPass::make(detail);
    if (!objects) return objects.error();
    return Stage(std::move(cast), std::move(*backdrop), std::move(*objects));
}

void Stage::set(const game::Snapshot& snapshot, bool backdropOnly) {
    objects_.begin();
    if (!backdropOnly) cast_.show(snapshot, objects_);
    objects_.upload();
}

Status Stage::draw(const Surround& surround, int eye, const render::View& view,
                   const render::Exposure& exposure, const render::Water& water, render::Glossy glossy) {
    // Every pixel gets a colour from an object or from the backdrop: only the depth needs clearing.
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    const render::SurroundGpu& gpu = surround.gpu(eye);
    const glm::mat3 turn = surround.envFromWorld();
    using Part = render::ObjectPass::Part;
    // First, though objects hide some of it: asking the depth for every pixel costs more than that.
    if (Status s = backdrop_.draw(gpu, view, turn, exposure); !s) return s;
    if (Status s = objects_.draw(Part::Opaque, gpu, view, turn, exposure, water, glossy); !s) return s;
    return objects_.draw(Part::Blended, gpu, view, turn, exposure, water, glossy);
}

} // namespace shoal::app
