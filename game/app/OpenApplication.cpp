// What a dive needs before it begins.
#include "game/app/Application.h"

#include "engine/core/Files.h"
#include "engine/gl/Renderer.h"
#include "game/app/FlatDisplay.h"
#include "game/app/HeadsetDisplay.h"
#include "game/session/Scores.h"

namespace shoal::app {

namespace {

render::Composition compositionIn(const PlayOptions& options) {
    return options.backdropOnly ? render::Composition::BackgroundOnly : options.compose;
}

Immersed immersedIn(const PlayOptions& options, const game::DiveFile& dive) {
    if (options.water != WaterChoice::Auto)
        return options.water == WaterChoice::On ? Immersed::Yes : Immersed::No;
    if (!options.environment.isOwnVideo()) return Immersed::IfItLooksSo;
    return dive.water ? Immersed::Yes : Immersed::No;
}

// The video that is shown; empty for a still.
Path videoIn(const EnvironmentOptions& options, const std::string& divesVideo) {
    if (!options.photo.empty() || !options.env.empty()) return {};
    return options.video.empty() ? dataRoot() / "content" / divesVideo : Path(options.video);
}

Result<CreatureModels> loadModels(const SessionConfig& config, const PlayOptions& options,
                                  render::Detail detail) {
    std::vector<Path> models;
    for (const game::Species& species : config.species)
        models.push_back(dataRoot() / "content" / species.model);
    const Path folder = dataRoot() / "content" / "models";
    return CreatureModels::load(models, folder / "hand_left.glb", folder / "hand_right.glb",
                                enumName(options.skin), reflectanceIn(options.environment), detail);
}

} // namespace

Status Application::open() {
    auto config = makeSessionConfig(options_);
    if (!config) return config.error();
    config_ = std::move(*config);
    if (Status opened = openContext(); !opened) return opened;
    measurements_.setRenderer(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    gl::spreadRasterThreads();
    const bool software = gl::rendersInSoftware();
    const int samples = options_.look.samples > 0 ? options_.look.samples : software ? 1 : 4;
    // Before what takes longer: a headset fails more often.
    if (Status opened = openDisplay(samples); !opened) return opened;
    if (Status opened = openScene(software); !opened) return opened;
    openSoundAndHaptics();
    bestScore_ = bestScore(config_.dive.name);
    return Done{};
}

Status Application::openContext() {
    if (options_.headless) {
        auto context = platform::Headless::open();
        if (!context) return context.error();
        headless_ = std::move(*context);
        return Done{};
    }
    auto window =
        platform::Window::open({"Shoal", options_.look.size.x, options_.look.size.y, options_.fullscreen,
                                options_.vsync && !options_.timedemo && !options_.xr});
    if (!window) return window.error();
    window_ = std::move(*window);
    return Done{};
}

Status Application::openDisplay(int samples) {
    if (!options_.xr) {
        const FlatDisplayOptions flat{.size = options_.look.size,
                                      .sideBySide = options_.stereo == StereoOutput::SideBySide,
                                      .verticalFov = glm::radians(options_.fov_deg),
                                      .eyeDistance_m = options_.eyeDistance_mm * 1e-3f,
                                      .samples = samples};
        display_ = std::make_unique<FlatDisplay>(window_ ? &*window_ : nullptr, flat);
        return Done{};
    }
    auto headset = HeadsetDisplay::open(*window_, config_.rig, samples);
    if (!headset) return headset.error();
    display_ = std::make_unique<HeadsetDisplay>(std::move(*headset));
    return Done{};
}

Status Application::openScene(bool software) {
    const render::Detail detail = software ? render::Detail::Lean : render::Detail::Full;
    auto models = loadModels(config_, options_, detail);
    if (!models) return models.error();
    const bool own = options_.environment.isOwnVideo();
    const bool shadows = options_.shadows == ShadowChoice::On && own && !config_.dive.ground.empty();
    auto environment =
        Environment::open({.options = options_.environment,
                           .defaultVideo = dataRoot() / "content" / config_.dive.video,
                           .bothEyes = options_.stereo == StereoOutput::SideBySide || options_.xr,
                           .pyramid = options_.look.glossy == render::Glossy::PhongRings,
                           .minRoughness = models->minRoughness(),
                           .immersed = immersedIn(options_, config_.dive),
                           .cameraResponse = compositionIn(options_) == render::Composition::CameraResponse,
                           .eyeHeight_m = own ? std::optional<float>(-config_.dive.floor_m) : std::nullopt,
                           .findLights = own && shadows,
                           .wait = [&] { return !window_ || !window_->poll().closing; }});
    if (!environment) return environment.error();
    environment_ = std::move(*environment);
    if (own) config_.dive.videoLength_s = environment_->length_s();
    auto renderer = SceneRenderer::make(
        std::move(*models), {.detail = detail,
                             .snow = options_.snow,
                             .shadows = shadows,
                             .occlusion = options_.look.occlusion == Occlusion::Ellipsoids,
                             .shown = options_.look.shown,
                             .skip = options_.look.skip,
                             .compositor = {.composition = compositionIn(options_),
                                            .backend = options_.look.backend,
                                            .layerSamples = options_.look.samples,
                                            .frameIsCoded = environment_->gpu(0).frameIsCoded()}});
    if (!renderer) return renderer.error();
    sceneRenderer_ = std::move(*renderer);
    auto hud = Hud::make();
    if (!hud) return hud.error();
    hud_ = std::move(*hud);
    return Done{};
}

void Application::openSoundAndHaptics() {
    soundAndHaptics_ = SoundAndHaptics::open(
        {.sound = !options_.mute && !options_.headless,
         .haptics = options_.hapticStrength > 0 && !options_.headless,
         .headphones = options_.headphones,
         .volume = options_.volume,
         .hapticStrength = options_.hapticStrength,
         .doppler = options_.doppler,
         .video = environment_->live() ? Path() : videoIn(options_.environment, config_.dive.video),
         .videoLength_s = environment_->length_s(),
         .videoSound = options_.videoSound});
}

} // namespace shoal::app
