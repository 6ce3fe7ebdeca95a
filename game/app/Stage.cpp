#include "game/app/Stage.h"

namespace shoal::app {

Result<Stage> Stage::make(Cast cast, render::Detail detail, bool snow, bool occlusion) {
    auto backdrop = render::BackdropPass::make();
    if (!backdrop) return backdrop.error();
    auto objects = render::ObjectPass::make(detail, occlusion);
    if (!objects) return objects.error();
    std::optional<render::SnowPass> snowPass;
    if (snow) {
        auto made = render::SnowPass::make();
        if (!made) return made.error();
        snowPass = std::move(*made);
    }
    return Stage(std::move(cast), std::move(*backdrop), std::move(*objects), std::move(snowPass));
}

void Stage::set(const game::Snapshot& snapshot, bool backdropOnly) {
    objects_.begin();
    if (!backdropOnly) cast_.show(snapshot, objects_);
    objects_.upload();
    time_s_ = snapshot.time_s;
    backdropOnly_ = backdropOnly;
}

Status Stage::draw(const Surround& surround, int eye, const render::View& view,
                   const render::Exposure& exposure, const water::Water& water, render::Glossy glossy) {
    if (Status s = drawBackdrop(surround, eye, view, exposure); !s) return s;
    return drawObjects(surround, eye, view, exposure, water, glossy);
}

Status Stage::drawBackdrop(const Surround& surround, int eye, const render::View& view,
                           const render::Exposure& exposure) {
    // First, though objects hide some of it: asking the depth for every pixel costs more than that.
    return backdrop_.draw(surround.gpu(eye), view, surround.envFromWorld(), exposure);
}

Status Stage::drawObjects(const Surround& surround, int eye, const render::View& view,
                          const render::Exposure& exposure, const water::Water& water,
                          render::Glossy glossy) {
    // Every pixel gets a colour from an object or from the backdrop: only the depth needs clearing.
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    const render::SurroundGpu& gpu = surround.gpu(eye);
    const glm::mat3 turn = surround.envFromWorld();
    using Part = render::ObjectPass::Part;
    if (Status s = objects_.draw(Part::Opaque, gpu, view, turn, exposure, water, glossy); !s) return s;
    if (Status s = objects_.draw(Part::Blended, gpu, view, turn, exposure, water, glossy); !s) return s;
    if (!snow_ || backdropOnly_ || water.none()) return Done{};
    return snow_->draw(gpu, view, turn, exposure, water, time_s_);
}

} // namespace shoal::app
