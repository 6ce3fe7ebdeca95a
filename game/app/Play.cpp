// Opens what a dive needs, and plays it.
#include "game/app/Application.h"

#include "engine/core/Log.h"
#include "engine/gl/Renderer.h"
#include "engine/media/Pictures.h"
#include "game/app/FlatDisplay.h"
#include "game/app/HeadsetDisplay.h"
#include "game/settings/KeptFiles.h"
#include "game/tools/Commands.h"

#include <thread>

namespace shoal::app {

namespace {

render::Composition compositionIn(const PlayOptions& options) {
    return options.backdropOnly ? render::Composition::BackgroundOnly : options.compose;
}

// What the player has changed by keys, into the settings file.
void keepChanges(const PlayOptions& before, const PlayOptions& after) {
    if (after.volume == before.volume && after.fullscreen == before.fullscreen &&
        after.frameTimes == before.frameTimes)
        return;
    PlayOptions kept;
    const SettingsTable table = settingsOf(kept);
    loadSettings(table);
    if (after.volume != before.volume) kept.volume = after.volume;
    if (after.fullscreen != before.fullscreen) kept.fullscreen = after.fullscreen;
    if (after.frameTimes != before.frameTimes) kept.frameTimes = after.frameTimes;
    if (Status saved = saveSettings(table); !saved) log::warn("{}", saved.error().message());
}

} // namespace

Status Application::open() {
    if (Status s = makeSessionConfig(options_).moveTo(config_); !s) return s;
    if (Status opened = openContext(); !opened) return opened;
    statistics_.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    gl::spreadRasterThreads();
    const bool software = gl::rendersInSoftware();
    const int samples = options_.look.samples > 0 ? options_.look.samples : software ? 1 : 4;
    // Before what takes longer: a headset fails more often.
    if (Status opened = openDisplay(samples); !opened) return opened;
    if (Status opened = openScene(software); !opened) return opened;
    soundAndHaptics_.emplace(options_, environment_->file(), environment_->length_s());
    bestScore_ = bestScore(config_.dive.name);
    return Done{};
}

Status Application::openContext() {
    if (options_.headless) return platform::Headless::open().moveTo(headless_);
    return platform::Window::open({"Shoal", options_.look.size.x, options_.look.size.y, options_.fullscreen,
                                   options_.vsync && !options_.timedemo && !options_.xr})
        .moveTo(window_);
}

Status Application::openDisplay(int samples) {
    if (!options_.xr) {
        display_ = std::make_unique<FlatDisplay>(window_ ? &*window_ : nullptr, options_, samples);
        return Done{};
    }
    auto headset = HeadsetDisplay::open(*window_, config_.rig, samples);
    if (!headset) return headset.error();
    display_ = std::make_unique<HeadsetDisplay>(std::move(*headset));
    return Done{};
}

Status Application::openScene(bool software) {
    const render::Detail detail = software ? render::Detail::Lean : render::Detail::Full;
    auto models = CreatureModels::load(config_.species, enumName(options_.skin),
                                       reflectanceIn(options_.environment), detail);
    if (!models) return models.error();
    const bool own = options_.environment.isOwnVideo();
    const bool shadows = options_.shadows == ShadowChoice::On && own && !config_.dive.ground.empty();
    AnalysisOptions analysis{.pyramid = options_.look.glossy == render::Glossy::PhongRings,
                             .minRoughness = models->minRoughness(),
                             .lights = shadows,
                             .cameraResponse =
                                 compositionIn(options_) == render::Composition::CameraResponse};
    analysis.water = options_.water == WaterChoice::On ||
                     (options_.water == WaterChoice::Auto && (!own || config_.dive.water));
    const bool slow = software || std::thread::hardware_concurrency() < 4;
    const Path film = filmFor(dataRoot() / "content" / config_.dive.video, options_.film, slow);
    if (Status s = Environment::open({.options = options_.environment,
                                      .defaultVideo = film,
                                      .bothEyes = options_.stereo == StereoOutput::SideBySide || options_.xr,
                                      .waterIsCertain = own || options_.water == WaterChoice::On,
                                      .analysis = analysis,
                                      .wait = [&] { return !window_ || !window_->poll().closing; }})
                       .moveTo(environment_);
        !s)
        return s;
    if (own) config_.dive.videoLength_s = environment_->length_s();
    if (Status s = SceneRenderer::make(std::move(*models),
                                       {.detail = detail,
                                        .particles = options_.snow,
                                        .shadows = shadows,
                                        .occlusion = options_.look.occlusion == Occlusion::Ellipsoids,
                                        .shown = options_.look.shown,
                                        .skip = options_.look.skip,
                                        .compositor = {.composition = compositionIn(options_),
                                                       .backend = options_.look.backend,
                                                       .layerSamples = options_.look.samples,
                                                       .frameIsCoded = environment_->gpu(0).frameIsCoded()}})
                       .moveTo(sceneRenderer_);
        !s)
        return s;
    return Hud::make().moveTo(hud_);
}

// Before anything is played: what would be written at the end must have a place.
static Status checkOutputs(const PlayOptions& options) {
    if (!options.screenshot.empty() && media::writtenAs(options.screenshot) != media::WrittenAs::Png)
        return Error{options.screenshot, "screenshots are PNG files; let the name end in .png"};
    for (const std::string& file : {options.screenshot, options.record, options.stats})
        if (!file.empty())
            if (Status there = checkFolderOf(file); !there) return there;
    return Done{};
}

Status play(const PlayOptions& given) {
    PlayOptions options = given;
    if (!options.file.empty()) options.environment = environmentOf(options.file, options.environment);
    if (Status possible = checkOutputs(options); !possible) return possible;
    Application application(options);
    if (Status opened = application.open(); !opened) return opened;
    Status verdict = Done{};
    if (options.timedemo) verdict = application.runSession(false); // to warm up
    if (verdict) verdict = application.runSession(true);
    if (!options.headless) keepChanges(options, application.options());
    // What was asked for is written even when an expectation failed: it helps to see why.
    if (!options.screenshot.empty() && application.hasPicture())
        if (Status saved = application.saveScreenshot(); !saved) return saved;
    if (!options.stats.empty())
        if (Status written = writeStatistics(options.stats, application.statistics()); !written)
            return written;
    if (options.timedemo) printTimes(application.statistics(), application.showsLiveVideo());
    return verdict;
}

} // namespace shoal::app
