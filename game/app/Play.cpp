// The command `play`: opens a dive's content and plays it.
#include "engine/core/WriteFile.h"
#include "game/app/Application.h"

#include "engine/core/Log.h"
#include "engine/gl/Renderer.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"
#include "engine/media/live/LivePlayer.h"
#include "engine/xr/Headset.h"
#include "game/app/FlatDisplay.h"
#include "game/app/HeadsetDisplay.h"
#include "game/app/StopSignals.h"
#include "game/settings/KeptFiles.h"
#include "game/tools/Commands.h"
#include "game/ui/Pictures.h"
#include "game/views/FilmSpaceOf.h"

#include <algorithm>
#include <array>
#include <memory>
#include <thread>

namespace shoal::app {

namespace {

render::Composition compositionIn(const PlayOptions& options) {
    return options.look.skip == render::SkippedPass::Objects ? render::Composition::BackgroundOnly
                                                             : options.compose;
}

// Returns the dives with their titles and best scores; a dive whose file cannot be read is left out.
std::vector<DiveName> divesThereAre() {
    std::vector<DiveName> dives;
    auto scores = readAllScores();
    for (const std::string& name : game::diveNames()) {
        const auto files = game::loadDiveFiles(name);
        if (!files) {
            log::warn("{}", files.error().message());
            continue;
        }
        const std::vector<int>& top = scores[name].top;
        const std::string picture = "dives/" + name + ".jpg";
        const bool shown = std::filesystem::exists(dataRoot() / "content" / picture);
        dives.push_back({.name = name,
                         .title = files->dive.title,
                         .picture = shown ? picture : "",
                         .best = top.empty() ? 0 : top.front()});
    }
    // The default dive comes first.
    const auto first = std::ranges::find(dives, kFirstDive, &DiveName::name);
    if (first != dives.end()) std::rotate(dives.begin(), first, first + 1);
    return dives;
}

} // namespace

Application::Application(const PlayOptions& options) : options_(options), applied_(options) {
    if (!bindings_.parse(options.controls.bindings))
        log::warn("settings: \"bindings\" cannot be read; keys and buttons are as at first");
}

Status Application::open() {
    if (Status s = makeSessionConfig(options_).moveTo(config_); !s) return s;
    if (Status opened = openContext(); !opened) return opened;
    statistics_.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    gl::spreadRasterThreads();
    software_ = gl::rendersInSoftware();
    // The display comes before what takes longer to open: a headset fails more often.
    if (Status opened = openDisplay(); !opened) return opened;
    screens_.facts = {.species = &config_.species,
                      .dive = &config_.dive,
                      .dives = divesThereAre(),
                      .headset = xr::Headset::hasRuntime(),
                      .met = readGuide()};
    if (Status opened = openScene(); !opened) return opened;
    openSound();
    if (window_) setIcon();
    return Done{};
}

void Application::setIcon() {
    const auto icon = readSmallPicture(dataRoot() / "content/icon.png");
    if (!icon) return log::warn("{}", icon.error().message());
    window_->setIcon(*icon);
}

void Application::openSound() {
    soundAndHaptics_.emplace(options_, environment_->file(), environment_->length_s());
}

Status Application::openContext() {
    if (options_.headless) {
        if (Status opened = platform::Headless::open().moveTo(headless_); !opened) return opened;
        return Hud::make().moveTo(hud_);
    }
    if (Status opened =
            platform::Window::open({"Shoal", options_.look.size.x, options_.look.size.y, options_.fullscreen,
                                    options_.vsync && !options_.timedemo && !options_.xr})
                .moveTo(window_);
        !opened)
        return opened;
    if (Status made = Hud::make().moveTo(hud_); !made) return made;
    drawLoading(0); // no black window
    return Done{};
}

Status Application::openDisplay() {
    const int samples = gl::defaultSamples();
    quality_.reset(); // another display, another rate
    const bool vsync = options_.vsync && !options_.timedemo;
    if (!options_.xr) {
        if (window_) window_->setVsync(vsync);
        display_ = std::make_unique<FlatDisplay>(window_ ? &*window_ : nullptr, options_, samples);
        return Done{};
    }
    headsetReturn_.settle();
    auto headset = HeadsetDisplay::open(*window_, config_.rig, samples);
    if (!headset) return headset.error();
    window_->setVsync(false); // the headset sets the pace, not the onlookers' window
    display_ = std::make_unique<HeadsetDisplay>(std::move(*headset));
    showRoom();
    return Done{};
}

// Draws the loading screen over the film if it can be shown already, else over the colour of deep water.
bool Application::drawLoading(float progress) {
    if (!window_) return true;
    const platform::WindowInput& input = window_->poll();
    leaving_ |= input.closing || stopSignal() != 0;
    const glm::ivec2 size = window_->framebufferSize();
    if (!hud_ || size.x <= 0 || size.y <= 0) return !leaving_;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    glClearColor(0.02f, 0.11f, 0.16f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    if (sceneRenderer_ && environment_) {
        game::Snapshot nothing;
        sceneRenderer_->set(nothing, *environment_, environment_->exposure(options_.look.tone, 0));
        const auto hud = [&](HudPart, Audience, const render::View&, glm::ivec2 eye) {
            hud_->drawLoading(progress, textOptions(), eye);
        };
        if (display_->draw(Painter::of(*sceneRenderer_, hud), nothing, 1)) display_->present();
        return !leaving_;
    }
    hud_->drawLoading(progress, textOptions(), size);
    window_->present();
    return !leaving_;
}

render::Detail Application::detail() const { return software_ ? render::Detail::Lean : render::Detail::Full; }

Status Application::loadModels() {
    const auto said = [&](float share) { return drawLoading(share); };
    return CreatureModels::load(config_.species, game::speciesShown(config_.species, config_.dive),
                                enumName(options_.skin), reflectanceIn(options_.environment), detail(), said)
        .moveTo(models_);
}

EnvironmentSetup Application::environmentSetup(float minRoughness) {
    const bool own = options_.environment.isOwnVideo();
    AnalysisOptions analysis{.pyramid = options_.look.glossy == render::Glossy::PhongRings,
                             .minRoughness = minRoughness,
                             .lights = options_.shadows == ShadowChoice::On,
                             .cameraResponse =
                                 compositionIn(options_) == render::Composition::CameraResponse};
    analysis.water = options_.water == WaterChoice::On ||
                     (options_.water == WaterChoice::Auto && (!own || config_.dive.water));
    const bool slow = software_ || std::thread::hardware_concurrency() < 4;
    return {.options = options_.environment,
            .defaultVideo = filmFor(dataRoot() / "content" / config_.dive.video, options_.film, slow),
            .bothEyes = options_.stereo == StereoOutput::SideBySide || options_.xr,
            .drawsDepth = options_.look.skip != render::SkippedPass::Depth,
            .roomIsSeen = display_->seesRoom(),
            .waterIsCertain = own || options_.water == WaterChoice::On,
            .analysis = analysis,
            .wait = [this](float share) { return drawLoading(share); }};
}

Status Application::makeRenderer(CreatureModels models, render::Composition composition) {
    return SceneRenderer::make(
               std::move(models),
               {.detail = detail(),
                .particles = options_.snow && !options_.reducedMotion,
                .shadows = options_.shadows == ShadowChoice::On && environment_->hasDepthTrack(),
                .floorShadows = options_.shadows == ShadowChoice::On && display_->seesRoom(),
                .occlusion = options_.look.occlusion == Occlusion::Ellipsoids,
                .shown = options_.look.shown,
                .skip = options_.look.skip,
                .compositor = {.composition = composition,
                               .backend = options_.look.backend,
                               .frameIsCoded = environment_->gpu(0).frameIsCoded()}})
        .moveTo(sceneRenderer_);
}

// Gives the rules the distances of the film, none without a file. A replay recorded without them is played
// without them.
static Status findFilmSpace(const Path& film, const EnvironmentOptions& options, SessionConfig& config) {
    config.dive.space.reset();
    const bool wanted = !config.replay || game::needsFilmSpace(config.replay->header());
    if (wanted && !film.empty() && options.depth)
        config.dive.space = filmSpaceOf(film, glm::radians(options.envYaw_deg));
    return config.replay ? game::checkFilmSpace(config.replay->header(), config.dive.space.get()) : Done{};
}

// Opens the film first, so that there is a picture; then the models, and the light that they need.
Status Application::openScene() {
    const bool watched = window_ && !options_.xr && options_.environment.isOwnVideo();
    if (sceneRenderer_ && !models_) models_ = sceneRenderer_->takeModels();
    sceneRenderer_.reset();
    const bool reload = !models_ || models_->reflectance() != reflectanceIn(options_.environment) ||
                        models_->handVariant() != enumName(options_.skin) ||
                        models_->shownSpecies() != game::speciesShown(config_.species, config_.dive);
    if (reload) {
        models_.reset();
        if (watched) {
            if (Status s = Environment::open(environmentSetup(1)).moveTo(environment_); !s) return s;
            if (Status s = makeRenderer({}, render::Composition::BackgroundOnly); !s) return s;
        }
        if (Status loaded = loadModels(); !loaded) return loaded;
        sceneRenderer_.reset();
    }
    environment_.reset();
    if (leaving_) return Error{"", "left while it was loading"};
    if (Status s = Environment::open(environmentSetup(models_->minRoughness())).moveTo(environment_); !s)
        return s;
    if (options_.environment.isOwnVideo()) config_.dive.videoLength_s = environment_->length_s();
    const Path film = environment_->hasDepthTrack() ? environment_->file() : Path();
    if (Status s = findFilmSpace(film, options_.environment, config_); !s) return s;
    CreatureModels taken = std::move(*models_);
    models_.reset();
    screens_.facts.ownFilm = options_.environment.isOwnVideo();
    return makeRenderer(std::move(taken), compositionIn(options_));
}

// Checks, before anything is played, that all output files can be written.
static Status checkOutputsOf(const PlayOptions& options) {
    if (!options.screenshot.empty() && media::writtenAs(options.screenshot) != media::WrittenAs::Png)
        return Error{options.screenshot, "screenshots are PNG files; let the name end in .png"};
    const std::string& hands = options.hands.source; // such as replay:FILE
    const std::array outputs = {NamedFile{"--screenshot", options.screenshot},
                                NamedFile{"--record", options.record}, NamedFile{"--stats", options.stats}};
    const EnvironmentOptions& shown = options.environment;
    const std::array inputs = {NamedFile{"--hands", hands.substr(hands.find(':') + 1)},
                               NamedFile{"--video", shown.video}, NamedFile{"--photo", shown.photo},
                               NamedFile{"--env", shown.env}};
    return checkOutputs(outputs, inputs);
}

// Prints the name of a script that met its expectations, with its hash as in tests/equal_hashes.txt.
static void tellSummary(const std::string& summary, const Status& verdict) {
    if (verdict && !summary.empty()) std::printf("%s\n", summary.c_str());
}

// Returns whether a picture is needed. A live video always needs one: it has the clock's time.
static bool isSeen(const PlayOptions& options) {
    const auto address = media::liveAddress(options.environment.video);
    return !options.headless || options.timedemo || !options.screenshot.empty() || !address || *address;
}

// Plays a session without a picture, as fast as possible: of the film only its distances are read.
static Status playUnseen(const PlayOptions& options) {
    SessionConfig config;
    if (Status s = makeSessionConfig(options).moveTo(config); !s) return s;
    const EnvironmentOptions& environment = options.environment;
    const Path film =
        environment.video.empty() ? dataRoot() / "content" / config.dive.video : Path(environment.video);
    const bool still = !environment.photo.empty() || !environment.env.empty();
    const auto usable = still                       ? media::checkPicture(environment.photo + environment.env)
                        : !environment.isOwnVideo() ? media::checkVideo(film)
                                                    : Result<std::string>("");
    if (!usable) return usable.error();
    if (Status s = findFilmSpace(still ? Path() : film, environment, config); !s) return s;
    GameSession session(config);
    if (!options.record.empty())
        if (Status s = session.record(options.record); !s) return s;
    auto* mouse = std::get_if<MouseSource>(&session.source);
    const double frame_s = static_cast<double>(options.speed) / static_cast<double>(options.fps);
    const double end_s = static_cast<double>(options.at_s.value_or(1e9f));
    double passed_s = 0;
    const auto isOver = [&] {
        const bool results = mouse && session.after.phase == game::Phase::Results;
        return session.ended || results || passed_s >= end_s || stopSignal() != 0;
    };
    while (!isOver()) {
        if (mouse)
            mouse->frame(nullptr, options.controls, session.shown, static_cast<float>(frame_s),
                         glm::radians(options.fov_deg), 16.0f / 9);
        session.advance(frame_s);
        passed_s += frame_s;
    }
    if (Status ended = session.endRecording(); !ended) return ended;
    if (!options.stats.empty()) {
        const Statistics statistics{.renderer = "none",
                                    .caught = session.after.caught,
                                    .score = session.after.score,
                                    .stateHash = session.dive.stateHash(),
                                    .ticks = session.ticks};
        if (Status written = writeStatistics(options.stats, statistics); !written) return written;
    }
    tellSummary(session.summary, session.verdict);
    return session.verdict;
}

Status play(const PlayOptions& given) {
    PlayOptions options = given;
    if (!options.file.empty()) options.environment = environmentOf(options.file, options.environment);
    if (Status possible = checkOutputsOf(options); !possible) return possible;
    noteStopSignals();
    if (!isSeen(options)) return playUnseen(options);
    Application application(options);
    if (Status opened = application.open(); !opened) {
        if (application.leaving()) return Done{};
        return opened;
    }
    Status verdict = Done{};
    if (options.timedemo) verdict = application.run(false); // to warm up
    if (verdict) verdict = application.run(true);
    // The outputs are written even when an expectation failed: they help to see why.
    if (!options.screenshot.empty() && application.hasPicture())
        if (Status saved = application.saveScreenshot(); !saved) return saved;
    if (!options.stats.empty())
        if (Status written = writeStatistics(options.stats, application.statistics()); !written)
            return written;
    tellSummary(application.summary(), verdict);
    if (options.timedemo) printTimes(application.statistics(), application.showsLiveVideo());
    return verdict;
}

} // namespace shoal::app
