#include "tests/bench/compose/Theatre.h"

#include "engine/gl/Renderer.h"

#include <glm/gtc/quaternion.hpp>

namespace shoal::bench {

using namespace app;

GameSession runTo(const SessionConfig& plan, double time_s) {
    GameSession session(plan);
    while (session.shown.time_s < time_s) runOn(session, 1.0 / 60);
    return session;
}

void runOn(GameSession& session, double seconds) {
    if (auto* mouse = std::get_if<MouseSource>(&session.source))
        mouse->frame(nullptr, {}, session.shown, static_cast<float>(seconds), glm::radians(kFov_deg),
                     static_cast<float>(kPicture.x) / static_cast<float>(kPicture.y));
    session.advance(seconds);
}

Result<SceneRenderer> makeSceneRenderer(const SessionConfig& plan, render::Composition composition) {
    const bool software = gl::rendersInSoftware();
    const auto detail = software ? render::Detail::Lean : render::Detail::Full;
    auto cast = CreatureModels::load(plan.species, game::speciesShown(plan.species, plan.dive), "light",
                                     render::Reflectance::Coded, detail);
    if (!cast) return cast.error();
    return SceneRenderer::make(std::move(*cast),
                               {.detail = detail, .compositor = {.composition = composition}});
}

Result<std::unique_ptr<Environment>> openVideo(const Path& file) {
    return Environment::open(
        {.player = {.source = {.video = file.string(), .layout = media::Layout::Mono},
                    .analysis = {.minRoughness = 0.25f, .water = true, .cameraResponse = true}}});
}

render::View viewOf(const game::Snapshot& snapshot, float yaw_deg, int heightPixels) {
    render::View view;
    view.worldFromEye = glm::angleAxis(glm::radians(-yaw_deg), glm::vec3(0, 1, 0)) * snapshot.worldFromView;
    view.eyeWorld = snapshot.headWorld;
    view.verticalFov = glm::radians(kFov_deg);
    view.aspect = static_cast<float>(kPicture.x) / static_cast<float>(kPicture.y);
    view.heightPixels = heightPixels;
    return view;
}

Status drawPicture(SceneRenderer& sceneRenderer, const render::View& view, const gl::Target& target) {
    const SceneRenderer::Eye eye{0, view, target};
    return sceneRenderer.draw({&eye, 1});
}

Status drawObjectsAlone(SceneRenderer& sceneRenderer, const render::View& view, const gl::Target& target) {
    target.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    return sceneRenderer.drawObjectsAlone({0, view, target});
}

} // namespace shoal::bench
