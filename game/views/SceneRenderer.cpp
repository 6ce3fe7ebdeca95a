#include "game/views/SceneRenderer.h"

namespace shoal::app {

Result<SceneRenderer> SceneRenderer::make(CreatureModels creatureModels, const SceneRendererSetup& setup) {
    auto objects = render::ObjectPass::make(setup.detail, setup.occlusion, setup.shown);
    if (!objects) return objects.error();
    SceneRenderer renderer(std::move(creatureModels), std::move(*objects));
    renderer.skip_ = setup.skip;
    if (setup.snow) {
        auto snow = render::SnowPass::make();
        if (!snow) return snow.error();
        renderer.snow_ = std::move(*snow);
    }
    if (setup.shadows) {
        auto shadows = Shadows::make();
        if (!shadows) return shadows.error();
        renderer.shadows_ = std::move(*shadows);
    }
    if (Status s = renderer.setCompositor(setup.compositor); !s) return s.error();
    return renderer;
}

Status SceneRenderer::setCompositor(const render::CompositorSetup& setup) {
    auto compositor = render::makeCompositor(setup);
    if (!compositor) return compositor.error();
    compositor_ = std::move(*compositor);
    return Done{};
}

void SceneRenderer::set(const game::Snapshot& snapshot, const Environment& environment,
                        const render::Exposure& exposure, render::Glossy glossy) {
    environment_ = &environment;
    exposure_ = exposure;
    glossy_ = glossy;
    time_s_ = snapshot.time_s;
    headWorld_ = snapshot.headWorld;
    objects_.begin();
    if (!compositor_->drawsObjects()) return;
    creatureModels_.show(snapshot, objects_);
    if (shadows_)
        shadows_->set(objects_.bodies(),
                      floorLight(environment.shadowLight(), environment.envFromWorld(), snapshot.ground));
    objects_.upload(environment.envFromWorld());
}

render::EyePicture SceneRenderer::pictureOf(const Eye& eye) const {
    return {.environment = environment_->gpu(eye.eye),
            .envFromWorld = environment_->envFromWorld(),
            .view = eye.view,
            .exposure = exposure_,
            .canvas = eye.canvas,
            .eye = eye.eye,
            .sharesFrame = environment_->eyesSeeTheSame(),
            .filmed = {environment_->cameraResponse(), environment_->frameIndex()},
            .skip = skip_};
}

Status SceneRenderer::draw(std::span<const Eye> eyes, const render::Compositor::AfterEye& afterEye) {
    pictures_.clear();
    for (const Eye& eye : eyes) pictures_.push_back(pictureOf(eye));
    return compositor_->draw(pictures_, *this, afterEye);
}

Status SceneRenderer::drawObjectsAlone(const Eye& eye) {
    eye.canvas.bind();
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    return drawObjects(pictureOf(eye));
}

Status SceneRenderer::drawObjects(const render::EyePicture& picture) {
    if (skip_ == render::SkippedPass::Objects) return Done{};
    const gl::PassTimers::Scope scope(timers_, "objects");
    for (const auto part : {render::ObjectPass::Part::Opaque, render::ObjectPass::Part::Blended})
        if (Status s = objects_.draw(part, picture.environment, picture.view, picture.envFromWorld,
                                     picture.exposure, environment_->water(), glossy_);
            !s)
            return s;
    return Done{};
}

Status SceneRenderer::drawParticles(render::SnowPass::On on, const render::EyePicture& picture) {
    const water::Water water = environment_->water();
    if (!snow_ || water.none() || skip_ == render::SkippedPass::Particles) return Done{};
    const gl::PassTimers::Scope scope(timers_, "particles");
    return snow_->draw(on, picture.environment, picture.view, picture.envFromWorld, picture.exposure, water,
                       time_s_);
}

Status SceneRenderer::drawShadows(const render::EyePicture& picture, const render::ShadowPass::Cover* cover) {
    if (!shadows_ || skip_ == render::SkippedPass::Shadows) return Done{};
    const gl::PassTimers::Scope scope(timers_, "shadows");
    // The video was filmed from the world's origin; where each eye has a picture of its own, from beside it.
    const glm::vec3 filmedFrom = picture.sharesFrame ? glm::vec3(0) : picture.view.eyeWorld - headWorld_;
    return shadows_->draw(picture.view, filmedFrom, environment_->water(), cover);
}

std::span<const scene::Sphere> SceneRenderer::visibleSpheres(const render::View& view) {
    return objects_.visibleSpheres(view);
}

int SceneRenderer::drawCount() const {
    return objects_.drawCount() + 1 + (snow_ ? 1 : 0) + (shadows_ ? shadows_->drawCount() : 0);
}

} // namespace shoal::app
