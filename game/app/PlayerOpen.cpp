// What a dive needs before it begins.
#include "game/app/Player.h"

#include "engine/core/Files.h"
#include "engine/gl/Renderer.h"
#include "game/app/Scores.h"

namespace shoal::app {

namespace {

Compose composeNamed(const std::string& name) {
    return name == "plain"        ? Compose::Plain
           : name == "resolution" ? Compose::Resolution
           : name == "texels"     ? Compose::Texels
                                  : Compose::Camera;
}

Immersed immersedIn(const PlayOptions& options, const game::DiveFile& dive) {
    if (options.water != "auto") return options.water == "on" ? Immersed::Yes : Immersed::No;
    if (!isOwnVideo(options.surround)) return Immersed::IfItLooksSo;
    return dive.water ? Immersed::Yes : Immersed::No;
}

// The video that is shown; empty for a still.
Path videoIn(const SurroundOptions& options, const std::string& divesVideo) {
    if (!options.photo.empty() || !options.env.empty()) return {};
    return options.video.empty() ? dataRoot() / "content" / divesVideo : Path(options.video);
}

} // namespace

Status Player::open() {
    auto made = makePlan(options);
    if (!made) return made.error();
    plan = std::move(*made);
    if (options.headless) {
        auto context = platform::Headless::open();
        if (!context) return context.error();
        headless = std::move(*context);
    } else {
        auto opened =
            platform::Window::open({"Shoal", options.look.size.x, options.look.size.y, options.fullscreen,
                                    options.vsync && !options.timedemo && !options.xr});
        if (!opened) return opened.error();
        window = std::move(*opened);
    }
    statistics.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const bool software = gl::rendersInSoftware();
    gl::spreadRasterThreads();
    const render::Detail detail = software ? render::Detail::Lean : render::Detail::Full;
    samples = options.look.samples > 0 ? options.look.samples : software ? 1 : 4;

    if (options.xr) { // before what takes longer: it fails more often
        auto put = XrPlay::open(samples);
        if (!put) return put.error();
        headset = std::move(*put);
    }

    std::vector<Path> models;
    for (const game::Species& species : plan.species)
        models.push_back(dataRoot() / "content" / species.model);
    const Path folder = dataRoot() / "content" / "models";
    auto cast = Cast::load(models, folder / "hand_left.glb", folder / "hand_right.glb", options.skin,
                           reflectanceIn(options.surround), detail);
    if (!cast) return cast.error();
    const bool own = isOwnVideo(options.surround);
    const bool shadows = options.shadows == "on" && own && !plan.dive.ground.empty();
    auto opened =
        Surround::open({.options = options.surround,
                        .defaultVideo = dataRoot() / "content" / plan.dive.video,
                        .bothEyes = stereo() || options.xr,
                        .pyramid = options.look.glossy == "phong36",
                        .leastRoughness = cast->leastRoughness(),
                        .immersed = immersedIn(options, plan.dive),
                        .filmLook = composeNamed(options.compose) == Compose::Camera,
                        .eyeHeight_m = own ? std::optional<float>(-plan.dive.floor_m) : std::nullopt,
                        .findLights = own && shadows,
                        .wait = [&] { return !window || !window->poll().closing; }});
    if (!opened) return opened.error();
    surround = std::move(*opened);
    if (own) plan.dive.videoLength_s = surround->length_s();
    auto madeStage = Stage::make(
        std::move(*cast), {.detail = detail,
                           .snow = options.snow,
                           .shadows = shadows,
                           .occlusion = options.look.occlusion == "on",
                           .compose = composeNamed(options.compose),
                           .layerSamples = options.look.samples > 0
                                               ? options.look.samples
                                               : layerSamplesFor(composeNamed(options.compose), software)});
    if (!madeStage) return madeStage.error();
    stage = std::move(*madeStage);
    auto madeHud = Hud::make();
    if (!madeHud) return madeHud.error();
    hud = std::move(*madeHud);
    outputs = Outputs::open({.sound = !options.mute && !options.headless,
                             .haptics = options.hapticStrength > 0 && !options.headless,
                             .headphones = options.headphones,
                             .volume = options.volume,
                             .hapticStrength = options.hapticStrength,
                             .doppler = options.doppler,
                             .video = surround->live() ? Path() : videoIn(options.surround, plan.dive.video),
                             .videoLength_s = surround->length_s(),
                             .videoSound = options.videoSound});
    if (options.quality == "auto" && !options.xr && ((window && !options.timedemo) || options.load_ms > 0))
        governor.emplace(window ? 1000 / window->refreshRate_Hz() : 1000.0 / 60);
    best = bestScore(plan.dive.name);
    return Done{};
}

} // namespace shoal::app
