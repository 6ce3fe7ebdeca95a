#include "game/app/Commands.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"
#include "engine/gl/Renderer.h"
#include "engine/gl/Target.h"
#include "engine/media/Pictures.h"
#include "engine/platform/Headless.h"
#include "engine/platform/Window.h"
#include "game/app/Governor.h"
#include "game/app/Hud.h"
#include "game/app/Outputs.h"
#include "game/app/Plan.h"
#include "game/app/Run.h"
#include "game/app/Scores.h"
#include "game/app/Settings.h"
#include "game/app/Stage.h"
#include "game/app/Statistics.h"
#include "game/app/Surround.h"
#include "game/app/XrPlay.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <thread>
#include <variant>

namespace shoal::app {

namespace {

using Clock = std::chrono::steady_clock;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

constexpr float kHintTime_s = 7;
constexpr double kSlowestFrame_s = 0.5;

Compose composeNamed(const std::string& name) {
    return name == "resolution" ? Compose::Resolution
           : name == "texels"   ? Compose::Texels
           : name == "camera"   ? Compose::Camera
                                : Compose::Plain;
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

// The program while it plays.
struct Player {
    const PlayOptions& options;
    Plan plan;
    std::optional<platform::Headless> headless; // the context first: it dies last
    std::optional<platform::Window> window;
    std::optional<XrPlay> headset; // with --xr; the window then shows what it shows
    std::optional<Surround> surround;
    std::optional<Stage> stage;
    std::optional<Hud> hud;
    std::optional<Outputs> outputs;
    std::vector<gl::Target> targets;  // one an eye
    std::vector<gl::Target> coarse;   // what the targets are enlarged from while the governor saves pixels
    std::optional<Governor> governor; // while somebody looks, and the quality is not fixed
    Statistics statistics;
    FrameTimes times;
    float volume = 0.8f;
    double volumeShown_s = -10;
    bool showTimes = false;
    int best = 0;
    bool newBest = false;
    bool scored = false;
    bool leaving = false;
    int samples = 1;

    explicit Player(const PlayOptions& o) : options(o), volume(o.volume) {}

    Status open();
    Status playThrough(bool measured);
    Status drawFrame(const Run& run, glm::ivec2 size);
    Status drawHeadset(const Run& run, glm::ivec2 size);
    render::Exposure exposure() const;
    render::Glossy glossy() const;
    Stage::Eye eyeOf(int eye, const render::View& view, glm::ivec2 size) const;
    HudInfo hudInfo(const Run& run, const render::View& view) const;
    const platform::WindowInput& readKeys(Run& run, double now_s);
    void govern(Clock::time_point frameBegan);
    Status saveScreenshot();
    void keepScore(const Run& run);
    std::span<const gl::Target> drawn() const { return headset ? headset->eyes() : targets; }
    bool stereo() const { return options.stereo == "sbs"; }
};

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
    auto madeStage =
        Stage::make(std::move(*cast), {.detail = detail,
                                       .snow = options.snow,
                                       .shadows = shadows,
                                       .occlusion = options.look.occlusion == "on",
                                       .compose = composeNamed(options.compose),
                                       .layerSamples = options.look.samples > 0 ? options.look.samples : 4});
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

render::Exposure Player::exposure() const {
    return {options.look.tone == "aces"     ? render::ToneCurve::Aces
            : options.look.tone == "linear" ? render::ToneCurve::Linear
                                            : surround->naturalTone(),
            plan.dive.exposure_ev + options.look.exposure_ev};
}

render::Glossy Player::glossy() const {
    return options.look.glossy == "phong36" ? render::Glossy::PhongRings : render::Glossy::Prefiltered;
}

Stage::Eye Player::eyeOf(int eye, const render::View& view, glm::ivec2 size) const {
    return {*surround, eye, view, exposure(), surround->water(), glossy(), size};
}

HudInfo Player::hudInfo(const Run& run, const render::View& view) const {
    const auto* mouse = std::get_if<MouseSource>(&run.source);
    const bool unused = mouse ? !mouse->used() : playedByAPerson(run.source) && run.shown.caught == 0;
    return {.snapshot = &run.shown,
            .view = &view,
            .captions = options.captions ? outputs->captions() : std::span<const HudCaption>(),
            .bestScore = best,
            .newBest = newBest,
            .showHints = unused && run.shown.time_s < kHintTime_s,
            .showTimes = showTimes,
            .times = &times,
            .lightName = surround->lightName(),
            .renderer = statistics.renderer,
            .notice = surround->notice().empty() && run.tracked ? run.tracked->caption()
                                                                : std::string_view(surround->notice()),
            .volume = volume,
            .showVolume = glfwGetTime() - volumeShown_s < 1.5 && window.has_value()};
}

// Both eyes, the panel with the text, and the window for those who look on. size: of the window.
Status Player::drawHeadset(const Run& run, glm::ivec2 size) {
    stage->set(run.shown, *surround, options.backdropOnly);
    const auto hudOn = [&](HudPart part, const render::View& view, glm::ivec2 pixels) {
        if (options.backdropOnly) return;
        HudInfo info = hudInfo(run, view);
        info.part = part;
        info.headset = true;
        info.showTimes &= part == HudPart::Panel;
        hud->draw(info, pixels);
    };
    const Quality quality = governor ? governor->quality() : Quality();
    Status drawn = headset->draw(
        {.scene = [&](int eye, const render::View& view, const gl::Target& canvas) -> Status {
             const Stage::Eye seen = eyeOf(eye, view, {canvas.width(), canvas.height()});
             if (Status s = stage->drawLayer(seen); !s) return s;
             canvas.bind();
             if (Status s = stage->drawBackdrop(seen); !s) return s;
             return stage->drawObjects(seen);
         },
         .marks = [&](const render::View& view, glm::ivec2 pixels) { hudOn(HudPart::Marks, view, pixels); },
         .panel = [&](const render::View& view, glm::ivec2 pixels) { hudOn(HudPart::Panel, view, pixels); }},
        quality.scale, size);
    if (!drawn || !headset->drew()) return drawn;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    if (!options.backdropOnly && size.x > 0 && size.y > 0) {
        HudInfo info = hudInfo(run, headset->windowView());
        info.part = HudPart::Panel; // the marks are in the picture already
        info.showHints = false;
        hud->draw(info, size);
    }
    times.draws = stage->drawCount();
    times.triangles = stage->triangleCount();
    times.quality = quality;
    return Done{};
}

Status Player::drawFrame(const Run& run, glm::ivec2 size) {
    const int eyes = stereo() ? 2 : 1;
    const glm::ivec2 eyeSize(std::max(1, size.x / eyes), std::max(1, size.y));
    if (targets.size() != static_cast<size_t>(eyes) || targets[0].width() != eyeSize.x ||
        targets[0].height() != eyeSize.y) {
        targets.clear();
        for (int eye = 0; eye < eyes; ++eye) targets.emplace_back(eyeSize.x, eyeSize.y, samples);
    }
    const Quality quality = governor ? governor->quality() : Quality();
    const glm::ivec2 drawnSize(glm::max(glm::vec2(eyeSize) * quality.scale + 0.5f, 1.0f));
    if (quality.scale == 1) {
        coarse.clear();
    } else if (coarse.size() != targets.size() || coarse[0].width() != drawnSize.x ||
               coarse[0].height() != drawnSize.y) {
        coarse.clear();
        for (int eye = 0; eye < eyes; ++eye) coarse.emplace_back(drawnSize.x, drawnSize.y, samples);
    }
    stage->set(run.shown, *surround, options.backdropOnly);
    const std::vector<gl::Target>& canvases = coarse.empty() ? targets : coarse;
    std::vector<Stage::Eye> seen;
    for (int eye = 0; eye < eyes; ++eye) {
        render::View view;
        view.worldFromEye = run.shown.worldFromView;
        const float side = eyes == 2 ? (eye == 0 ? -0.5f : 0.5f) * options.eyeDistance_mm * 1e-3f : 0.0f;
        view.eyeWorld = run.shown.headWorld + view.worldFromEye * glm::vec3(side, 0, 0);
        view.verticalFov = glm::radians(options.fov_deg);
        view.aspect = static_cast<float>(eyeSize.x) / static_cast<float>(eyeSize.y);
        view.heightPixels = drawnSize.y;
        seen.push_back(eyeOf(eye, view, drawnSize));
        if (Status drawn = stage->drawLayer(seen.back()); !drawn) return drawn;
    }
    for (const Stage::Eye& eye : seen) {
        const auto index = static_cast<size_t>(eye.eye);
        const gl::Target &target = targets[index], &canvas = canvases[index];
        canvas.bind();
        // The backdrop is infinitely far: parallel eyes see the same of it, and copying is quicker than
        // drawing.
        const bool shared =
            eyes == 2 && samples == 1 && surround->eyesSeeTheSame() && stage->eyesShareBackdrop();
        if (!shared || eye.eye == 0)
            if (Status drawn = stage->drawBackdrop(eye); !drawn) return drawn;
        if (shared && eye.eye == 0) {
            canvas.blitTo(canvases[1].framebuffer(), 0, drawnSize.x, drawnSize.y);
            canvas.bind();
        }
        if (Status drawn = stage->drawObjects(eye); !drawn) return drawn;
        if (!coarse.empty()) {
            canvas.blitTo(target.framebuffer(), 0, eyeSize.x, eyeSize.y);
            target.bind();
        }
        if (!options.backdropOnly) hud->draw(hudInfo(run, eye.view), eyeSize);
    }
    times.draws = stage->drawCount();
    times.quality = quality;
    times.triangles = stage->triangleCount();
    return Done{};
}

const platform::WindowInput& Player::readKeys(Run& run, double now_s) {
    const platform::WindowInput& input = window->poll();
    leaving |= input.closing;
    const bool results = run.after.phase == game::Phase::Results;
    const bool mine = playedByAPerson(run.source);
    // A headset's player looks at no window; whether it is worn is for XrPlay to say.
    if (mine && !headset && !input.focused && !results) run.paused = true;
    for (const int key : input.keysPressed) {
        switch (key) {
        case GLFW_KEY_ESCAPE:
            if (results || !mine)
                leaving = true;
            else
                run.paused = !run.paused;
            break;
        case GLFW_KEY_P:
            run.paused = mine && !run.paused && !results;
            break;
        case GLFW_KEY_Q:
            leaving |= run.paused || results;
            break;
        case GLFW_KEY_R:
            run.restart |= run.paused || results;
            break;
        case GLFW_KEY_ENTER:
            run.restart |= results;
            break;
        case GLFW_KEY_F1:
            showTimes = !showTimes;
            break;
        case GLFW_KEY_F11:
            window->toggleFullscreen();
            break;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            volume = std::min(1.0f, volume + 0.1f);
            break;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            volume = std::max(0.0f, volume - 0.1f);
            break;
        default:
            continue;
        }
        if (key == GLFW_KEY_EQUAL || key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_ADD ||
            key == GLFW_KEY_KP_SUBTRACT) {
            outputs->setVolume(volume);
            volumeShown_s = now_s;
        }
    }
    if (input.leftPressed && results) run.restart = true;
    if (run.restart) run.paused = false;
    return input;
}

void Player::keepScore(const Run& run) {
    const bool results = run.after.phase == game::Phase::Results;
    if (!results) {
        scored = newBest = false;
        return;
    }
    if (scored) return;
    scored = true;
    if (run.after.score <= best) return;
    best = run.after.score;
    newBest = true;
    // Only what a person has played counts.
    if (!options.headless && playedByAPerson(run.source))
        if (Status saved = saveBestScore(plan.dive.name, best); !saved)
            log::warn("{}", saved.error().sentence());
}

// Once a frame has been drawn, before the display is waited for.
void Player::govern(Clock::time_point frameBegan) {
    glFinish();
    governor->frame(secondsBetween(frameBegan, Clock::now()) * 1e3);
    const Quality quality = governor->quality();
    surround->setLightEvery(quality.lightEvery);
    statistics.leastScale = std::min(statistics.leastScale, quality.scale);
}

Status Player::saveScreenshot() {
    const std::span<const gl::Target> shown = drawn();
    const ImageRgba8 left = shown[0].read();
    const int eyes = static_cast<int>(shown.size());
    ImageRgb8 picture(left.width * eyes, left.height);
    for (int eye = 0; eye < eyes; ++eye) {
        const ImageRgba8 image = eye == 0 ? left : shown[static_cast<size_t>(eye)].read();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                std::copy_n(image.at(x, y), 3, picture.at(eye * left.width + x, y));
    }
    return media::writePng(options.screenshot, picture);
}

// One run from start to end. measured: its frames go into the statistics.
Status Player::playThrough(bool measured) {
    Run run(plan);
    const bool keep = !options.record.empty();
    const Clock::time_point began = Clock::now();
    Clock::time_point last = began;
    for (uint64_t frame = 0; !leaving; ++frame) {
        if (headset) {
            if (Status waited = headset->wait(); !waited) return waited;
            leaving |= headset->leaving();
            if (!governor && options.quality == "auto" && !options.timedemo && headset->period_s() > 0)
                governor.emplace(1000 * headset->period_s());
        }
        const Clock::time_point now = Clock::now();
        const double wall_s = std::min(secondsBetween(last, now), kSlowestFrame_s);
        last = now;
        // With a player in front, time is the clock's; else each picture is 1 / fps after the one before.
        const bool live = window && !options.timedemo;
        double elapsed_s = headset      ? std::min(headset->elapsed_s(), kSlowestFrame_s)
                           : live       ? wall_s
                           : frame == 0 ? 0
                                        : 1.0 / static_cast<double>(options.fps);
        const platform::WindowInput* input = window ? &readKeys(run, glfwGetTime()) : nullptr;
        if (headset) {
            headset->feed(run, plan.rig);
            if (run.paused && !playedByAPerson(run.source)) elapsed_s = 0; // a script waits for its onlooker
        }
        if (auto* mouse = std::get_if<MouseSource>(&run.source)) {
            const glm::ivec2 size = window ? window->framebufferSize() : options.look.size;
            mouse->frame(window ? &*window : nullptr, input, run.shown, static_cast<float>(elapsed_s),
                         glm::radians(options.fov_deg),
                         static_cast<float>(std::max(size.x, 1)) / static_cast<float>(std::max(size.y, 1)));
        }
        const Clock::time_point simBegan = Clock::now();
        run.advance(elapsed_s, keep);
        times.sim_ms = static_cast<float>(secondsBetween(simBegan, Clock::now()) * 1e3);
        outputs->frame(run.shown, run.events, static_cast<float>(elapsed_s),
                       headset || !input || input->focused, surround->videoPosition_s());
        if (headset)
            if (Status felt = headset->feel(outputs->felt(), run.paused); !felt) return felt;
        keepScore(run);

        // The video begins with the dive, pauses with it, and begins anew with it.
        const bool exact = !window && !options.timedemo;
        const bool fresh = surround->update(
            options.timedemo ? secondsBetween(began, Clock::now()) : run.shown.time_s, exact);
        if (fresh && measured) {
            statistics.light_ms.add(static_cast<double>(surround->light_ms()));
            statistics.decode_ms.add(static_cast<double>(surround->decode_ms()));
            statistics.upload_ms.add(static_cast<double>(surround->upload_ms()));
        }
        times.light_ms = surround->light_ms();
        times.decode_ms = surround->decode_ms();
        times.upload_ms = surround->upload_ms();

        const glm::ivec2 size = window ? window->framebufferSize() : options.look.size;
        if (headset) {
            if (Status drawn = drawHeadset(run, size); !drawn) return drawn;
            if (governor && headset->drew()) govern(now);
            if (headset->drew()) window->present();
        } else if (size.x > 0 && size.y > 0) { // not while minimised
            if (Status drawn = drawFrame(run, size); !drawn) return drawn;
            while (secondsBetween(now, Clock::now()) * 1e3 < static_cast<double>(options.load_ms)) {
            }
            if (governor) govern(now);
            if (window) {
                const int eyes = static_cast<int>(targets.size());
                for (int eye = 0; eye < eyes; ++eye)
                    targets[static_cast<size_t>(eye)].blitTo(0, eye * size.x / eyes, size.x / eyes, size.y);
                window->present();
            }
        }
        glFinish();
        const double frame_ms = secondsBetween(now, Clock::now()) * 1e3;
        times.add(static_cast<float>(frame_ms));
        if (measured && frame > 0) statistics.frame_ms.add(frame_ms);
        if (const media::LivePlayer* stream = surround->live(); stream && measured) {
            statistics.live.add(*stream, fresh && frame > 0);
            // What is live has the clock's time: a dive without a player goes no faster.
            if (!window && !options.timedemo)
                std::this_thread::sleep_until(
                    began + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                                static_cast<double>(frame + 1) / static_cast<double>(options.fps))));
        }

        if (run.ended) break;
        if (options.at_s && run.shown.time_s >= static_cast<double>(*options.at_s)) break;
        if (options.at_s && static_cast<double>(frame) >= static_cast<double>(*options.at_s * options.fps) &&
            !window)
            break;
        const bool alone = !window && std::holds_alternative<MouseSource>(run.source);
        if ((alone || options.timedemo) && std::holds_alternative<MouseSource>(run.source) &&
            run.after.phase == game::Phase::Results)
            break;
    }
    statistics.draws = times.draws;
    statistics.triangles = times.triangles;
    statistics.caught = run.after.caught;
    statistics.score = run.after.score;
    statistics.stateHash = run.dive.stateHash();
    statistics.ticks = run.ticks;
    if (keep && measured)
        if (Status written = sim::writeRecording(options.record, run.recording); !written) return written;
    return run.verdict;
}

} // namespace

int play(const PlayOptions& options) {
    const auto failed = [](const Error& error) {
        log::error("{}", error.sentence());
        return 1;
    };
    Player player(options);
    if (Status opened = player.open(); !opened) return failed(opened.error());
    Status verdict = Done{};
    if (options.timedemo) verdict = player.playThrough(false);
    if (verdict) verdict = player.playThrough(true);
    if (!options.headless && player.volume != options.volume) {
        Settings settings = loadSettings();
        settings.volume = player.volume;
        if (Status saved = saveSettings(settings); !saved) log::warn("{}", saved.error().sentence());
    }
    // What was asked for is written even when an expectation failed: it helps to see why.
    if (!options.screenshot.empty() && !player.drawn().empty())
        if (Status saved = player.saveScreenshot(); !saved) return failed(saved.error());
    if (!options.stats.empty())
        if (Status written = writeStatistics(options.stats, player.statistics); !written)
            return failed(written.error());
    if (options.timedemo)
        std::printf("%s: %zu frames, median %.2f ms, 99th percentile %.2f ms, worst %.2f ms\n",
                    player.statistics.renderer.c_str(), player.statistics.frame_ms.count(),
                    player.statistics.frame_ms.quantile(0.5), player.statistics.frame_ms.quantile(0.99),
                    player.statistics.frame_ms.quantile(1));
    if (options.timedemo && player.surround->live())
        std::printf("%s\n", describe(player.statistics.live).c_str());
    if (!verdict) return failed(verdict.error());
    return 0;
}

} // namespace shoal::app
