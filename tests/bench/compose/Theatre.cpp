#include "tests/bench/compose/Theatre.h"

#include "engine/gl/Renderer.h"

#include <glm/gtc/quaternion.hpp>

namespace shoal::bench {

using namespace app;

Run runTo(const Plan& plan, double time_s) {
    Run run(plan);
    while (run.shown.time_s < time_s) runOn(run, 1.0 / 60);
    return run;
}

void runOn(Run& run, double seconds) {
    if (auto* mouse = std::get_if<MouseSource>(&run.source))
        mouse->frame(nullptr, nullptr, run.shown, static_cast<float>(seconds), glm::radians(kFov_deg),
                     static_cast<float>(kPicture.x) / static_cast<float>(kPicture.y));
    run.advance(seconds, false);
}

Result<Stage> makeStage(const Plan& plan, Compose compose) {
    std::vector<Path> models;
    for (const game::Species& species : plan.species)
        models.push_back(dataRoot() / "content" / species.model);
    const Path folder = dataRoot() / "content/models";
    const bool software = gl::rendersInSoftware();
    const auto detail = software ? render::Detail::Lean : render::Detail::Full;
    auto cast = Cast::load(models, folder / "hand_left.glb", folder / "hand_right.glb", "light",
                           render::Reflectance::Coded, detail);
    if (!cast) return cast.error();
    return Stage::make(std::move(*cast), {.detail = detail,
                                          .snow = false,
                                          .compose = compose,
                                          .layerSamples = layerSamplesFor(compose, software)});
}

Result<Surround> openVideo(const Path& file, const Plan& plan) {
    SurroundSetup setup;
    setup.options.video = file.string();
    setup.options.layout = "mono";
    setup.leastRoughness = 0.25f;
    setup.immersed = Immersed::Yes;
    setup.eyeHeight_m = -plan.dive.floor_m;
    setup.filmLook = true;
    return Surround::open(setup);
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

Status drawPicture(Stage& stage, const Surround& surround, const render::View& view,
                   const gl::Target& target) {
    const Stage::Eye eye{surround,
                         0,
                         view,
                         {},
                         surround.water(),
                         render::Glossy::Prefiltered,
                         {target.width(), target.height()}};
    if (Status s = stage.drawLayer(eye); !s) return s;
    target.bind();
    if (Status s = stage.drawBackdrop(eye); !s) return s;
    return stage.drawObjects(eye);
}

Status drawObjectsAlone(Stage& stage, const Surround& surround, const render::View& view,
                        const gl::Target& target) {
    target.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    return stage.drawObjects({surround,
                              0,
                              view,
                              {},
                              surround.water(),
                              render::Glossy::Prefiltered,
                              {target.width(), target.height()}});
}

} // namespace shoal::bench
