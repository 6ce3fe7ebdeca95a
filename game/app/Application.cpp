// Runs the frames of a dive.
#include "game/app/Application.h"

#include "engine/core/Log.h"
#include "engine/media/Pictures.h"
#include "game/app/DiveStates.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <variant>

namespace shoal::app {

struct Application::Frame {
    GameSession& session;
    DiveStates& states;
    FrameClock& clock;
    double elapsed_s = 0;
    const platform::WindowInput* input = nullptr; // null: there is no window
    bool freshVideo = false;                      // a new frame of the video is shown
};

Status Application::runSession(bool measured) {
    GameSession session(config_);
    DiveStates states(session, config_.dive.name, bestScore_, !options_.headless, leaving_);
    FrameClock clock(options_.timedemo ? FrameClock::Mode::TimeDemo
                     : window_         ? FrameClock::Mode::RealTime
                                       : FrameClock::Mode::FixedStep,
                     static_cast<double>(options_.fps));
    statistics_ = {.renderer = std::move(statistics_.renderer)};
    while (!leaving_) {
        if (Status begun = display_->begin(); !begun) return begun;
        clock.beginFrame();
        Frame frame{session, states, clock, clock.elapsed_s(display_->elapsed_s())};
        readInput(frame);
        simulate(frame);
        if (Status done = display_->vibrate(soundAndHaptics_->hapticFrame(), session.paused); !done)
            return done;
        states.update();
        // The video begins with the dive, pauses with it, and begins anew with it.
        frame.freshVideo = environment_->update(clock.video_s(session.shown.time_s), clock.exactVideo());
        const Result<bool> drawn = draw(frame);
        if (!drawn) return drawn.error();
        if (*drawn) {
            clock.waste(static_cast<double>(options_.load_ms));
            adjustQuality(clock);
            display_->present();
        }
        glFinish();
        measure(frame);
        if (measured && environment_->live()) clock.waitForLiveVideo();
        if (isOver(frame)) break;
    }
    statistics_.caught = session.after.caught;
    statistics_.score = session.after.score;
    statistics_.stateHash = session.dive.stateHash();
    statistics_.ticks = session.ticks;
    if (measured && !options_.record.empty())
        if (Status written = sim::writeRecording(options_.record, session.recording); !written)
            return written;
    return session.verdict;
}

void Application::readInput(Frame& frame) {
    GameSession& session = frame.session;
    leaving_ |= display_->leaving();
    if (window_) {
        frame.input = &window_->poll();
        leaving_ |= frame.input->closing;
        for (const int key : frame.input->keysPressed) globalKey(key);
        // A headset's player looks at no window; whether it is worn is for the headset to say.
        frame.states.input(*frame.input, display_->audience() == Audience::WindowPlayer);
    }
    display_->feed(session);
    // In a headset a script waits for its onlooker.
    if (display_->audience() == Audience::HeadsetPlayer && session.paused && !frame.states.byPerson())
        frame.elapsed_s = 0;
    if (auto* mouse = std::get_if<MouseSource>(&session.source)) {
        const glm::ivec2 size = window_ ? window_->framebufferSize() : options_.look.size;
        mouse->frame(window_ ? &*window_ : nullptr, frame.input, session.shown,
                     static_cast<float>(frame.elapsed_s), glm::radians(options_.fov_deg),
                     static_cast<float>(std::max(size.x, 1)) / static_cast<float>(std::max(size.y, 1)));
    }
}

// Keys that do the same in every state.
void Application::globalKey(int key) {
    const bool louder = key == GLFW_KEY_EQUAL || key == GLFW_KEY_KP_ADD;
    const bool quieter = key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_SUBTRACT;
    if (key == GLFW_KEY_F1) options_.frameTimes = !options_.frameTimes;
    if (key == GLFW_KEY_F11) {
        options_.fullscreen = !options_.fullscreen;
        window_->toggleFullscreen();
    }
#ifndef NDEBUG
    if (key == GLFW_KEY_F5)
        if (Status reloaded = sceneRenderer_->reloadShaders(); !reloaded)
            log::warn("{}", reloaded.error().message());
#endif
    if (options_.mute || (!louder && !quieter)) return;
    options_.volume = std::clamp(options_.volume + (louder ? 0.1f : -0.1f), 0.0f, 1.0f);
    soundAndHaptics_->setVolume(options_.volume);
    volumeShown_s_ = glfwGetTime();
}

void Application::simulate(Frame& frame) {
    GameSession& session = frame.session;
    const auto began = std::chrono::steady_clock::now();
    session.advance(frame.elapsed_s, !options_.record.empty());
    statistics_.sim_ms =
        std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began).count();
    const bool attended =
        display_->audience() == Audience::HeadsetPlayer || !frame.input || frame.input->focused;
    soundAndHaptics_->frame(session.shown, session.events, static_cast<float>(frame.elapsed_s), attended,
                            environment_->videoPosition_s());
}

Result<bool> Application::draw(const Frame& frame) {
    const game::Snapshot& shown = frame.session.shown;
    const bool wantsQuality =
        options_.quality == QualityControl::Auto && ((window_ && !options_.timedemo) || options_.load_ms > 0);
    if (wantsQuality && !quality_ && display_->period_s() > 0) quality_.emplace(1000 * display_->period_s());
    const Quality quality = quality_ ? quality_->quality() : Quality();
    const render::Exposure exposure{environment_->toneCurve(options_.look.tone),
                                    config_.dive.exposure_ev + options_.look.exposure_ev};
    sceneRenderer_->timers().beginFrame(options_.frameTimes);
    sceneRenderer_->set(shown, *environment_, exposure, options_.look.glossy);
    const Result<bool> drawn = display_->draw(
        {.scene = [&](std::span<const SceneRenderer::Eye> eyes,
                      const Painter::AfterEye& afterEye) { return sceneRenderer_->draw(eyes, afterEye); },
         .hud =
             [&](HudPart part, Audience audience, const render::View& view, glm::ivec2 size) {
                 if (options_.backdropOnly || options_.look.skip == render::SkippedPass::Overlay) return;
                 const gl::PassTimers::Scope scope(sceneRenderer_->timers(), "overlay");
                 drawHud(frame, part, audience, view, size);
             }},
        shown, quality.scale);
    statistics_.draws = sceneRenderer_->drawCount();
    statistics_.triangles = sceneRenderer_->triangleCount();
    return drawn;
}

void Application::measure(const Frame& frame) {
    const bool first = frame.clock.frame() == 0;
    if (!first) statistics_.frame_ms.add(frame.clock.sinceBegin_ms());
    if (frame.freshVideo) {
        statistics_.light_ms.add(static_cast<double>(environment_->light_ms()));
        statistics_.decode_ms.add(static_cast<double>(environment_->decode_ms()));
        statistics_.upload_ms.add(static_cast<double>(environment_->upload_ms()));
    }
    const media::LivePlayer* live = environment_->live();
    if (!live) return;
    statistics_.live = live->counts();
    if (!frame.freshVideo || first) return;
    statistics_.liveLatency_ms.add(1e3 * live->age_s());
    statistics_.liveDisplayFrames.add(live->displayFrames());
}

void Application::drawHud(const Frame& frame, HudPart part, Audience audience, const render::View& view,
                          glm::ivec2 size) {
    const GameSession& session = frame.session;
    const bool onHeadsetsEye = audience == Audience::HeadsetPlayer && part != HudPart::Panel;
    const std::string_view notice = environment_->notice();
    hud_->draw(
        {.part = part,
         .audience = audience,
         .snapshot = &session.shown,
         .view = &view,
         .captions = options_.captions ? soundAndHaptics_->captions() : std::span<const game::Caption>(),
         .overlay = [&](const Pen& pen) { frame.states.drawOverlay(pen); },
         .showTimes = options_.frameTimes && !onHeadsetsEye,
         .statistics = &statistics_,
         .quality = quality_ ? quality_->quality() : Quality(),
         .passes = sceneRenderer_->timers().times(),
         .environment = &*environment_,
         .notice = notice.empty() && session.tracked ? session.tracked->caption() : notice,
         .volume = options_.volume,
         .showVolume = window_ && glfwGetTime() - volumeShown_s_ < 1.5},
        size);
}

// Once a frame has been drawn, before the display is waited for.
void Application::adjustQuality(const FrameClock& clock) {
    if (!quality_) return;
    glFinish();
    quality_->frame(clock.sinceBegin_ms());
    environment_->setLightEvery(quality_->quality().lightEvery);
    statistics_.minScale = std::min(statistics_.minScale, quality_->quality().scale);
}

bool Application::isOver(const Frame& frame) const {
    const GameSession& session = frame.session;
    if (session.ended) return true;
    if (options_.at_s) {
        const auto at_s = static_cast<double>(*options_.at_s);
        const double frames = at_s * static_cast<double>(options_.fps);
        if (session.shown.time_s >= at_s) return true;
        if (!window_ && static_cast<double>(frame.clock.frame()) >= frames) return true;
    }
    // Nobody is there to look at the results.
    return (!window_ || options_.timedemo) && std::holds_alternative<MouseSource>(session.source) &&
           frame.states.state() == DiveStates::State::Results;
}

Status Application::saveScreenshot() const {
    const std::span<const gl::Target> shown = display_->pictures();
    const ImageRgba8 left = shown[0].read();
    const int eyes = static_cast<int>(shown.size());
    ImageRgb8 picture(left.width * eyes, left.height);
    for (int eye = 0; eye < eyes; ++eye) {
        const ImageRgba8 image = eye == 0 ? left : shown[static_cast<size_t>(eye)].read();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                std::copy_n(image.at(x, y), 3, picture.at(eye * left.width + x, y));
    }
    return media::writePng(options_.screenshot, picture);
}

} // namespace shoal::app
