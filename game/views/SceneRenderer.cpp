#include "game/views/SceneRenderer.h"

#include "engine/core/Log.h"

#include <utility>

namespace shoal::app {

Result<SceneRenderer::Passes> SceneRenderer::makePasses(const SceneRendererSetup& setup) {
    auto objects = render::ObjectPass::make(setup.detail, setup.occlusion, setup.shown);
    if (!objects) return objects.error();
    Passes passes{std::move(*objects), {}, {}, {}};
    if (setup.snow) {
        auto snow = render::SnowPass::make();
        if (!snow) return snow.error();
        passes.snow = std::move(*snow);
    }
    if (setup.shadows) {
        auto shadows = Shadows::make();
        if (!shadows) return shadows.error();
        passes.shadows = std::move(*shadows);
    }
    auto compositor = render::makeCompositor(setup.compositor);
    if (!compositor) return compositor.error();
    passes.compositor = std::move(*compositor);
    return passes;
}

Result<SceneRenderer> SceneRenderer::make(CreatureModels creatureModels, const SceneRendererSetup& setup) {
    auto passes = makePasses(setup);
    if (!passes) return passes.error();
    return SceneRenderer(std::move(creatureModels), setup, std::move(*passes));
}

Status SceneRenderer::setCompositor(const render::CompositorSetup& setup) {
    auto compositor = render::makeCompositor(setup);
    if (!compositor) return compositor.error();
    passes_.compositor = std::move(*compositor);
    setup_.compositor = setup;
    return Done{};
}

Status SceneRenderer::reloadShaders() {
    auto passes = makePasses(setup_);
    if (!passes) return passes.error();
    beforeReload_ = std::exchange(passes_, std::move(*passes));
    return Done{};
}

void SceneRenderer::set(const game::Snapshot& snapshot, const Environment& environment,
                        const render::Exposure& exposure, render::Glossy glossy) {
    environment_ = &environment;
    exposure_ = exposure;
    glossy_ = glossy;
    time_s_ = snapshot.time_s;
    headWorld_ = snapshot.headWorld;
    passes_.objects.begin();
    if (!passes_.compositor->drawsObjects()) return;
    creatureModels_.show(snapshot, passes_.objects);
    if (passes_.shadows)
        passes_.shadows->set(
            passes_.objects.bodies(),
            floorLight(environment.shadowLight(), environment.envFromWorld(), snapshot.ground));
    passes_.objects.upload(environment.envFromWorld());
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
            .skip = setup_.skip};
}

Status SceneRenderer::draw(std::span<const Eye> eyes, const render::Compositor::AfterEye& afterEye) {
    pictures_.clear();
    for (const Eye& eye : eyes) pictures_.push_back(pictureOf(eye));
    Status drawn = passes_.compositor->draw(pictures_, *this, afterEye);
    if (drawn || !beforeReload_) return drawn;
    log::warn("{}", drawn.error().message());
    passes_ = std::move(*beforeReload_); // they draw from the next frame on
    beforeReload_.reset();
    return Done{};
}

Status SceneRenderer::drawObjectsAlone(const Eye& eye) {
    eye.canvas.bind();
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    return drawObjects(pictureOf(eye));
}

Status SceneRenderer::drawObjects(const render::EyePicture& picture) {
    if (setup_.skip == render::SkippedPass::Objects) return Done{};
    const gl::PassTimers::Scope scope(timers_, "objects");
    for (const auto part : {render::ObjectPass::Part::Opaque, render::ObjectPass::Part::Blended})
        if (Status s = passes_.objects.draw(part, picture.environment, picture.view, picture.envFromWorld,
                                            picture.exposure, environment_->water(), glossy_);
            !s)
            return s;
    return Done{};
}

Status SceneRenderer::drawParticles(render::SnowPass::On on, const render::EyePicture& picture) {
    const water::Water water = environment_->water();
    if (!passes_.snow || water.none() || setup_.skip == render::SkippedPass::Particles) return Done{};
    const gl::PassTimers::Scope scope(timers_, "particles");
    return passes_.snow->draw(on, picture.environment, picture.view, picture.envFromWorld, picture.exposure,
                              water, time_s_);
}

Status SceneRenderer::drawShadows(const render::EyePicture& picture, const render::ShadowPass::Cover* cover) {
    if (!passes_.shadows || setup_.skip == render::SkippedPass::Shadows) return Done{};
    const gl::PassTimers::Scope scope(timers_, "shadows");
    // The video was filmed from the world's origin; where each eye has a picture of its own, from beside it.
    const glm::vec3 filmedFrom = picture.sharesFrame ? glm::vec3(0) : picture.view.eyeWorld - headWorld_;
    return passes_.shadows->draw(picture.view, filmedFrom, environment_->water(), cover);
}

std::span<const scene::Sphere> SceneRenderer::visibleSpheres(const render::View& view) {
    return passes_.objects.visibleSpheres(view);
}

int SceneRenderer::drawCount() const {
    return passes_.objects.drawCount() + 1 + (passes_.snow ? 1 : 0) +
           (passes_.shadows ? passes_.shadows->drawCount() : 0);
}

} // namespace shoal::app
