#include "game/app/Stage.h"

namespace shoal::app {

Result<Stage> Stage::make(Cast cast, const StageSetup& setup) {
    auto backdrop = render::BackdropPass::make();
    if (!backdrop) return backdrop.error();
    auto objects = render::ObjectPass::make(setup.detail);
    if (!objects) return objects.error();
    Stage stage(std::move(cast), std::move(*backdrop), std::move(*objects));
    if (setup.snow) {
        auto snow = render::SnowPass::make();
        if (!snow) return snow.error();
        stage.snow_ = std::move(*snow);
    }
    stage.layerSamples_ = setup.layerSamples;
    for (int eye = 0; eye < 2 && setup.compose == Compose::Resolution; ++eye) {
        auto layer = render::LayerPass::make();
        if (!layer) return layer.error();
        stage.layers_.push_back(std::move(*layer));
    }
    return stage;
}

void Stage::set(const game::Snapshot& snapshot, bool backdropOnly) {
    objects_.begin();
    if (!backdropOnly) cast_.show(snapshot, objects_);
    objects_.upload();
    time_s_ = snapshot.time_s;
    backdropOnly_ = backdropOnly;
}

glm::ivec2 Stage::layerSize(const Eye& eye) const {
    if (layers_.empty() || backdropOnly_) return eye.size;
    return render::sizeAsFine(eye.view, eye.size, eye.surround.gpu(eye.eye).frameHeight());
}

Status Stage::drawSnow(render::SnowPass::On on, const Eye& eye, const render::View& view) {
    if (!snow_ || backdropOnly_ || eye.water.none()) return Done{};
    return snow_->draw(on, eye.surround.gpu(eye.eye), view, eye.surround.envFromWorld(), eye.exposure,
                       eye.water, time_s_);
}

Status Stage::drawBodies(const Eye& eye, const render::View& view) {
    for (const auto part : {render::ObjectPass::Part::Opaque, render::ObjectPass::Part::Blended})
        if (Status s = objects_.draw(part, eye.surround.gpu(eye.eye), view, eye.surround.envFromWorld(),
                                     eye.exposure, eye.water, eye.glossy);
            !s)
            return s;
    return Done{};
}

Status Stage::drawLayer(const Eye& eye) {
    const glm::ivec2 size = layerSize(eye);
    if (size == eye.size) return Done{};
    render::LayerPass& layer = layers_[static_cast<size_t>(eye.eye)];
    render::View view = eye.view;
    view.heightPixels = size.y;
    layer.begin(size, layerSamples_);
    if (Status s = drawBodies(eye, view); !s) return s;
    if (Status s = drawSnow(render::SnowPass::On::Objects, eye, view); !s) return s;
    layer.end();
    return Done{};
}

Status Stage::drawBackdrop(const Eye& eye) {
    // First, though objects hide some of it: asking the depth for every pixel costs more than that.
    return backdrop_.draw(eye.surround.gpu(eye.eye), eye.view, eye.surround.envFromWorld(), eye.exposure);
}

Status Stage::drawObjects(const Eye& eye) {
    // Every pixel gets a colour from an object or from the backdrop: only the depth needs clearing.
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    const bool layered = layerSize(eye) != eye.size;
    if (!layered)
        if (Status s = drawBodies(eye, eye.view); !s) return s;
    // Of a layer, all specks lie behind its objects here; those before them are in it.
    if (Status s = drawSnow(render::SnowPass::On::Everything, eye, eye.view); !s) return s;
    if (layered) layers_[static_cast<size_t>(eye.eye)].layOver(objects_.seen(eye.view));
    return Done{};
}

} // namespace shoal::app
