#include "game/app/Stage.h"

#include <utility>

namespace shoal::app {

namespace {
// A layer's picture is so much wider than the eye's: the backdrop's filter looks a texel beyond the edge.
constexpr float kBeyond = 1.02f;
} // namespace

Result<Stage> Stage::make(Cast cast, const StageSetup& setup) {
    auto backdrop = render::BackdropPass::make();
    if (!backdrop) return backdrop.error();
    auto objects = render::ObjectPass::make(setup.detail, setup.occlusion);
    if (!objects) return objects.error();
    Stage stage(std::move(cast), std::move(*backdrop), std::move(*objects));
    if (setup.snow) {
        auto snow = render::SnowPass::make();
        if (!snow) return snow.error();
        stage.snow_ = std::move(*snow);
    }
    if (setup.shadows) {
        auto shadows = Shadows::make(stage.cast_.silhouettes());
        if (!shadows) return shadows.error();
        stage.shadows_ = std::move(*shadows);
    }
    stage.layerSamples_ = setup.layerSamples;
    stage.compose_ = setup.compose;
    for (int eye = 0; eye < 2 && setup.compose != Compose::Plain; ++eye) {
        auto layer = render::LayerPass::make();
        if (!layer) return layer.error();
        stage.layers_.push_back(std::move(*layer));
        if (setup.compose == Compose::Resolution) continue;
        auto frame = render::LatLongPass::make();
        if (!frame) return frame.error();
        stage.frames_.push_back(std::move(*frame));
    }
    return stage;
}

void Stage::set(const game::Snapshot& snapshot, const Surround& surround, bool backdropOnly) {
    if (shadows_ && !backdropOnly)
        shadows_->set(snapshot,
                      floorLight(surround.castingLight(), surround.envFromWorld(), snapshot.ground));
    headWorld_ = snapshot.headWorld;
    objects_.begin();
    if (!backdropOnly) cast_.show(snapshot, objects_);
    objects_.upload(surround.envFromWorld());
    time_s_ = snapshot.time_s;
    backdropOnly_ = backdropOnly;
}

glm::ivec2 Stage::layerSize(const Eye& eye) const {
    if (layers_.empty() || backdropOnly_) return eye.size;
    if (compose_ == Compose::Camera && !paintsTexels(eye)) return eye.size;
    auto rows = static_cast<float>(eye.surround.gpu(eye.eye).frameHeight());
    if (compose_ == Compose::Camera) rows /= render::layerTexels(eye.surround.filmLook(), layerSamples_);
    return render::sizeAsFine(layerView(eye), eye.size, static_cast<int>(rows));
}

// Only what is display-coded can hold what is drawn: an HDR picture cannot.
bool Stage::paintsTexels(const Eye& eye) const {
    return !frames_.empty() && !backdropOnly_ && eye.surround.gpu(eye.eye).frameIsCoded();
}

render::View Stage::layerView(const Eye& eye) const {
    return paintsTexels(eye) ? render::widened(eye.view, kBeyond) : eye.view;
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
    if (size == eye.size && !paintsTexels(eye)) return Done{};
    render::LayerPass& layer = layers_[static_cast<size_t>(eye.eye)];
    render::View view = layerView(eye);
    view.heightPixels = size.y;
    layer.begin(size, layerSamples_);
    Eye drawn = eye;
    if (paintsTexels(eye)) drawn.exposure = {}; // what is in the frame is exposed with it
    if (Status s = drawBodies(drawn, view); !s) return s;
    if (Status s = drawSnow(render::SnowPass::On::Objects, drawn, view); !s) return s;
    layer.end();
    return Done{};
}

void Stage::chooseTexels(const Eye& eye) {
    if (!paintsTexels(eye)) return;
    const render::SurroundGpu& surround = eye.surround.gpu(eye.eye);
    tiles_.choose({surround.frameWidth(), surround.frameHeight()}, eye.surround.envFromWorld(),
                  objects_.ballsSeen(layerView(eye)), eye.view.eyeWorld);
}

render::BackdropPass::InMemory Stage::inMemory(const Eye& eye) const {
    return {*eye.surround.frameInMemory(eye.eye), paintsTexels(eye) ? &tiles_ : nullptr};
}

void Stage::beginBackdrop(const Eye& eye) {
    if (!eye.surround.frameInMemory(eye.eye)) return;
    chooseTexels(eye);
    texelsChosen_ = true;
    backdrop_.begin(eye.surround.gpu(eye.eye), eye.view, eye.surround.envFromWorld(), eye.exposure, eye.size,
                    inMemory(eye));
}

Status Stage::paintFrame(const Eye& eye) {
    GLint canvas = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &canvas);
    const render::Filmed filmed{eye.surround.filmLook(), eye.surround.frameIndex()};
    // A frame that both eyes see holds one eye's objects after the other's.
    const size_t frame = eye.surround.eyesSeeTheSame() ? 0 : static_cast<size_t>(eye.eye);
    Status painted = frames_[frame].paint(
        eye.surround.gpu(eye.eye), tiles_, layers_[static_cast<size_t>(eye.eye)].layer().texture(),
        layerView(eye), eye.surround.envFromWorld(), compose_ == Compose::Camera ? &filmed : nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(canvas));
    glViewport(0, 0, eye.size.x, eye.size.y);
    return painted;
}

Status Stage::drawFromMemory(const Eye& eye) {
    const render::SurroundGpu& surround = eye.surround.gpu(eye.eye);
    const auto draw = [&](const render::TexelPaint* paint) {
        return backdrop_.drawFromMemory(surround, eye.view, eye.surround.envFromWorld(), inMemory(eye),
                                        paint);
    };
    if (!paintsTexels(eye)) return draw(nullptr);
    render::LayerPass& layer = layers_[static_cast<size_t>(eye.eye)];
    const render::View view = layerView(eye);
    render::TexelPaint paint{
        .layer = layer.read().data(),
        .layerSize = {layer.layer().width(), layer.layer().height()},
        .eyeFromEnv = glm::transpose(eye.surround.envFromWorld() * glm::mat3_cast(view.worldFromEye)),
        .rayScale = view.halfExtent(),
        .rayShift = view.shift};
    if (compose_ != Compose::Camera) return draw(&paint);
    const camera::FilmLook look = eye.surround.filmLook();
    const render::FilmedNumbers numbers = render::numbersOf({look, eye.surround.frameIndex()});
    if (grain_.empty()) grain_ = render::makeGrain();
    paint.filmed = &numbers;
    paint.grainy = (render::filmedFeatures(look) & render::kGrainy) != 0;
    paint.grain = grain_.data();
    paint.scattered = &surround.scatteredLight();
    return draw(&paint);
}

Status Stage::drawBackdrop(const Eye& eye) {
    if (!std::exchange(texelsChosen_, false)) chooseTexels(eye);
    const render::SurroundGpu& surround = eye.surround.gpu(eye.eye);
    // First, though objects hide some of it: asking the depth for every pixel costs more than that.
    Status drawn = Done{};
    if (eye.surround.frameInMemory(eye.eye) && backdrop_.canDrawFromMemory(surround, eye.exposure)) {
        drawn = drawFromMemory(eye);
    } else {
        if (paintsTexels(eye)) drawn = paintFrame(eye);
        if (drawn) drawn = backdrop_.draw(surround, eye.view, eye.surround.envFromWorld(), eye.exposure);
    }
    // The video was filmed from the world's origin; where each eye has a picture of its own, from beside it.
    const glm::vec3 filmedFrom =
        eye.surround.eyesSeeTheSame() ? glm::vec3(0) : eye.view.eyeWorld - headWorld_;
    if (!drawn || !shadows_ || backdropOnly_) return drawn;
    render::ShadowPass::Cover cover{0, kBeyond, eye.size};
    if (paintsTexels(eye)) cover.texture = layers_[static_cast<size_t>(eye.eye)].layer().texture();
    return shadows_->draw(eye.view, filmedFrom, eye.water, cover.texture ? &cover : nullptr);
}

bool Stage::needsDepth(const Eye& eye) const { return !paintsTexels(eye) && layerSize(eye) == eye.size; }

Status Stage::drawObjects(const Eye& eye) {
    if (needsDepth(eye)) {
        // Every pixel gets a colour from an object or from the backdrop: only the depth needs clearing.
        glDepthMask(GL_TRUE);
        glClear(GL_DEPTH_BUFFER_BIT);
        if (Status s = drawBodies(eye, eye.view); !s) return s;
        return drawSnow(render::SnowPass::On::Everything, eye, eye.view);
    }
    // Of a layer, all specks lie behind its objects here; those before them are in it.
    if (Status s = drawSnow(render::SnowPass::On::Picture, eye, eye.view); !s) return s;
    if (paintsTexels(eye)) return Done{};
    layers_[static_cast<size_t>(eye.eye)].layOver(objects_.seen(eye.view));
    return Done{};
}

} // namespace shoal::app
