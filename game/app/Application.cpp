// Runs the frames of title screen and dives.
#include "game/app/Application.h"

#include "engine/core/Log.h"
#include "engine/media/Pictures.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <variant>

namespace shoal::app {

namespace {

constexpr float kTitleTurn_radps = 0.03f; // of the view behind the title
constexpr float kStepsStay_s = 2.5f;      // from the end of the first steps until the dive begins
constexpr float kResultsRest_s = 0.8f;    // in which the results take no choice
constexpr double kMinimisedWait_s = 0.25; // between looks at a window that shows nothing

} // namespace

Status Application::run(bool measured) {
    if (Status begun = begin(firstMode()); !begun) return begun;
    while (!leaving_) {
        if (Status done = frame(measured); !done) return done;
        if (const auto request = screens_.takeRequest())
            if (Status answered = answer(*request); !answered) return answered;
        if (isOver()) break; // first: a player who leaves while a film loads has ended the session
        if (play_->stepsDone_s > kStepsStay_s)
            if (Status begun = endFirstSteps(); !begun) return begun;
    }
    return endPlay(measured);
}

// A person who has not said where to begin begins at the title.
Mode Application::firstMode() const {
    const bool person = !config_.script && !config_.replay;
    const bool watched = window_ && !options_.timedemo && !options_.at_s && options_.record.empty();
    const bool asked =
        options_.start == Start::Dive || options_.freeSwim || options_.xr || !options_.dive.empty();
    const bool title = options_.start == Start::Title || (options_.start == Start::Auto && !asked);
    if (person && watched && title) return Mode::Title;
    return options_.freeSwim ? Mode::FreeSwim : Mode::Dive;
}

Status Application::begin(Mode mode) {
    if (Status ended = endPlay(true); !ended) return ended;
    SessionConfig config = config_;
    if (!config.script && !config.replay) config.rules.freeSwim = mode != Mode::Dive;
    statistics_ = {.renderer = std::move(statistics_.renderer)};
    const FrameClock::Mode clock = options_.timedemo ? FrameClock::Mode::TimeDemo
                                   : window_         ? FrameClock::Mode::RealTime
                                                     : FrameClock::Mode::FixedStep;
    play_.emplace(config, screens_, mode, !options_.headless, clock, static_cast<double>(options_.fps));
    if (mode == Mode::FirstSteps) play_->steps.emplace(config_.rig);
    return Done{};
}

// Writes what the session was to leave, and returns its verdict.
Status Application::endPlay(bool measured) {
    if (!play_) return Done{};
    GameSession& session = play_->session;
    statistics_.caught = session.after.caught;
    statistics_.score = session.after.score;
    statistics_.stateHash = session.dive.stateHash();
    statistics_.ticks = session.ticks;
    const bool records = measured && !options_.record.empty() && play_->states.mode() != Mode::Title;
    const Status written = records ? sim::writeRecording(options_.record, session.recording) : Status(Done{});
    const Status verdict = session.verdict;
    play_.reset();
    return written ? verdict : written;
}

Status Application::frame(bool measured) {
    if (Status begun = display_->begin(); !begun) return begun;
    GameSession& session = play_->session;
    play_->clock.beginFrame();
    play_->elapsed_s = play_->clock.elapsed_s(display_->elapsed_s()) * static_cast<double>(options_.speed);
    readInput();
    simulate();
    if (Status done = display_->vibrate(soundAndHaptics_->hapticFrame(), session.paused); !done) return done;
    play_->states.update();
    // The video begins with the dive, pauses with it, and begins anew with it.
    play_->freshVideo =
        environment_->update(play_->clock.video_s(session.shown.time_s), play_->clock.exactVideo());
    const Result<bool> drawn = draw();
    if (!drawn) return drawn.error();
    if (*drawn) {
        play_->clock.waste(static_cast<double>(options_.load_ms));
        adjustQuality();
        display_->present();
    }
    glFinish();
    measure();
    if (measured && environment_->live()) play_->clock.waitForLiveVideo();
    return Done{};
}

void Application::readInput() {
    GameSession& session = play_->session;
    ProgramStates& states = play_->states;
    leaving_ |= display_->leaving();
    if (window_) {
        const bool still = states.state() != ProgramStates::State::Diving;
        if (play_->input && play_->input->minimised && still) window_->wait(kMinimisedWait_s);
        play_->input = &window_->poll();
        leaving_ |= play_->input->closing;
        play_->controls = readControls(*window_, *play_->input, bindings_);
        noteDevice();
        const bool menus = screens_.isOpen();
        globalActions(play_->controls);
        if (photo_) {
            window_->holdCursor(play_->controls.turns);
            return photograph();
        }
        // A headset's player looks at no window; whether it is worn is for the headset to say.
        const bool windowPlayer = display_->audience() == Audience::WindowPlayer;
        if (!menus || !states.byPerson())
            states.input(play_->controls, windowPlayer && !play_->input->focused, leaving_);
        if (menus && states.byPerson()) readMenuInput();
        for (const std::string& file : play_->input->droppedFiles)
            if (states.byPerson()) screens_.dropped(file);
    }
    display_->feed(session);
    // In a headset a script waits for its onlooker.
    if (display_->audience() == Audience::HeadsetPlayer && session.paused && !states.byPerson())
        play_->elapsed_s = 0;
    auto* mouse = std::get_if<MouseSource>(&session.source);
    if (!mouse) return;
    const auto dt_s = static_cast<float>(play_->elapsed_s);
    if (states.idle()) return mouse->idle(dt_s, options_.reducedMotion ? 0.0f : kTitleTurn_radps);
    const glm::ivec2 size = window_ ? window_->framebufferSize() : options_.look.size;
    if (window_) window_->holdCursor(!screens_.isOpen() && play_->controls.turns);
    if (screens_.isOpen()) return mouse->release();
    mouse->frame(window_ ? &play_->controls : nullptr, options_.controls, session.shown, dt_s,
                 glm::radians(options_.fov_deg),
                 static_cast<float>(std::max(size.x, 1)) / static_cast<float>(std::max(size.y, 1)));
}

// Which of them the player has in hand: what is said on the screen follows it.
void Application::noteDevice() {
    const platform::WindowInput& input = *play_->input;
    const platform::Gamepad& pad = input.gamepad;
    if (!input.keysPressed.empty() || input.leftPressed || input.cursorMoved != glm::dvec2(0))
        byGamepad_ = false;
    if (!pad.pressed.empty() || pad.leftStick != glm::vec2(0) || pad.rightStick != glm::vec2(0))
        byGamepad_ = true;
}

void Application::readMenuInput() {
    const platform::WindowInput& input = *play_->input;
    if (screens_.capturesKey()) {
        if (!input.keysPressed.empty())
            screens_.keyPressed(input.keysPressed.front());
        else if (!input.gamepad.pressed.empty())
            screens_.buttonPressed(input.gamepad.pressed.front());
        else if (input.leftPressed)
            screens_.cancelCapture();
        return;
    }
    std::array<hands::HandPose, 2> hands{};
    if (play_->session.tracked) hands = play_->session.tracked->seen();
    if (const auto* headset = std::get_if<OpenXrSource>(&play_->session.source)) hands = headset->seen();
    const glm::vec2 size = glm::vec2(window_->framebufferSize()) / glm::vec2(eyes(), 1);
    const float tanY = std::tan(glm::radians(options_.fov_deg) / 2);
    MenuInput menu =
        menuControls_.step(&input, &*window_, hands, {tanY * size.x / std::max(size.y, 1.0f), tanY}, size,
                           eyes(), static_cast<float>(play_->elapsed_s));
    // The dive ends while the player's button is busy: what was meant for a fish chooses nothing.
    if (play_->states.state() == ProgramStates::State::Results) {
        play_->results_s += static_cast<float>(play_->elapsed_s);
        if (play_->results_s < kResultsRest_s) menu.accept = menu.pressed = menu.back = false;
    }
    screens_.input(menu);
}

// What does the same in every state.
void Application::globalActions(const Controls& controls) {
    if (screens_.capturesKey()) return;
    if (controls.was(Action::Performance)) options_.frameTimes = !options_.frameTimes;
    if (controls.was(Action::Fullscreen)) options_.fullscreen = !options_.fullscreen;
#ifndef NDEBUG
    for (const int key : play_->input->keysPressed)
        if (key == GLFW_KEY_F5)
            if (Status reloaded = sceneRenderer_->reloadShaders(); !reloaded)
                log::warn("{}", reloaded.error().message());
#endif
    const int louder = controls.was(Action::Louder) - controls.was(Action::Quieter);
    if (louder != 0 && !options_.mute) {
        options_.volume = std::clamp(options_.volume + 0.1f * static_cast<float>(louder), 0.0f, 1.0f);
        volumeShown_s_ = glfwGetTime();
    }
    if (options_.volume != applied_.volume || options_.fullscreen != applied_.fullscreen ||
        options_.frameTimes != applied_.frameTimes) {
        for (const char* key : {"volume", "fullscreen", "frame-times"}) screens_.keep(key);
        applySettings();
    }
}

Status Application::answer(const Request& request) {
    GameSession& session = play_->session;
    switch (request.kind) {
    case Request::Kind::Resume:
        session.paused = false;
        return Done{};
    case Request::Kind::Restart:
        session.restart = true;
        session.paused = false;
        play_->results_s = 0;
        if (auto* mouse = std::get_if<MouseSource>(&session.source)) mouse->recentre();
        return Done{};
    case Request::Kind::Dive:
        return startDive(request.name, options_.firstSteps ? Mode::FirstSteps : Mode::Dive);
    case Request::Kind::SkipFirstSteps:
        return endFirstSteps();
    case Request::Kind::Swim:
        return startDive(config_.dive.name, Mode::FreeSwim);
    case Request::Kind::Title:
        return begin(Mode::Title);
    case Request::Kind::OpenFilm:
        return openFilm(request.name);
    case Request::Kind::OwnFilm:
        return openFilm({});
    case Request::Kind::Headset:
        return startHeadset();
    case Request::Kind::Photo:
        photo_.emplace(session.shown);
        playFov_deg_ = options_.fov_deg;
        photoNotice_ = (byGamepad_ ? game::Text("A takes a picture; B goes back")
                                   : game::Text("Space or a click takes a picture; Esc goes back"))
                           .in(languageIn(options_.text));
        screens_.close();
        return Done{};
    case Request::Kind::SettingsChanged:
        applySettings();
        return Done{};
    case Request::Kind::Quit:
        leaving_ = true;
        return Done{};
    }
    return Done{};
}

Status Application::startDive(const std::string& name, Mode mode) {
    if (name != config_.dive.name) {
        options_.dive = name;
        if (Status ended = endPlay(true); !ended) return ended;
        if (Status s = makeSessionConfig(options_).moveTo(config_); !s) return s;
        if (Status opened = openScene(); !opened) return opened;
    } else if (!options_.seed)
        config_.seed = drawnSeed();
    return begin(mode);
}

// The dive begins, and every later one begins at once.
Status Application::endFirstSteps() {
    options_.firstSteps = false;
    screens_.keep("first-steps");
    return begin(Mode::Dive);
}

void Application::photograph() {
    const Controls& controls = play_->controls;
    photo_->move(controls, options_.controls.sensitivity, static_cast<float>(play_->elapsed_s),
                 options_.fov_deg);
    const bool enter =
        std::ranges::find(play_->input->keysPressed, GLFW_KEY_ENTER) != play_->input->keysPressed.end();
    if (enter || play_->input->leftPressed || controls.was(Action::CloseHand)) savePhotos();
    const bool back = std::ranges::find(play_->input->gamepad.pressed, GLFW_GAMEPAD_BUTTON_B) !=
                      play_->input->gamepad.pressed.end();
    if (!controls.was(Action::Pause) && !back) return;
    photo_.reset();
    photoNotice_.clear();
    options_.fov_deg = playFov_deg_;
    screens_.open(Screen::Paused);
}

// The picture, with nothing written over it, and one of all directions.
void Application::savePhotos() {
    constexpr int kAroundWidth = 4096;
    if (display_->pictures().empty()) return;
    photoNotice_.clear();
    if (const Result<bool> drawn = draw(); !drawn || !*drawn) return;
    const Path file = newPictureFile(""), around = newPictureFile("-360");
    Status saved = media::writePng(file, pictureShown());
    if (saved) {
        const auto drawn = drawAround(*sceneRenderer_, photo_->shown().headWorld, kAroundWidth);
        saved = drawn ? media::writePng(around, *drawn) : Status(drawn.error());
    }
    photoNotice_ = saved ? file.string() : saved.error().message();
    log::info("{}", photoNotice_);
}

// Where there is none after all, the title screen says why.
Status Application::startHeadset() {
    if (Status ended = endPlay(true); !ended) return ended;
    options_.xr = true;
    Status opened = makeSessionConfig(options_).moveTo(config_);
    if (opened) opened = openDisplay();
    if (opened) opened = openScene();
    if (opened) return begin(Mode::Dive);
    log::warn("{}", opened.error().message());
    options_.xr = false;
    if (Status s = makeSessionConfig(options_).moveTo(config_); !s) return s;
    if (Status back = openDisplay(); !back) return back;
    if (Status back = openScene(); !back) return back;
    if (Status begun = begin(Mode::Title); !begun) return begun;
    screens_.say(opened.error().message());
    return Done{};
}

// A file that cannot be opened is said on the page, and what was shown before stays.
Status Application::openFilm(const std::string& file) {
    const EnvironmentOptions before = options_.environment;
    options_.environment.video = options_.environment.photo = options_.environment.env = {};
    if (!file.empty()) options_.environment = environmentOf(file, options_.environment);
    if (Status ended = endPlay(true); !ended) return ended;
    if (Status opened = openScene(); !opened) {
        if (leaving_) return Done{};
        log::warn("{}", opened.error().message());
        options_.environment = before;
        if (Status back = openScene(); !back) return back;
        if (Status begun = begin(Mode::Title); !begun) return begun;
        screens_.showFilms(opened.error().message());
        return Done{};
    }
    return begin(Mode::Title);
}

// Settings that do not take effect by being read in every frame.
void Application::applySettings() {
    if (options_.volume != applied_.volume) soundAndHaptics_->setVolume(options_.volume);
    soundAndHaptics_->setMix(options_.effects, options_.videoSound, options_.hapticStrength);
    if (options_.fullscreen != applied_.fullscreen) window_->toggleFullscreen();
    if (options_.quality == QualityControl::Fixed) quality_.reset();
    if (options_.compose != applied_.compose || options_.skin != applied_.skin ||
        options_.snow != applied_.snow || options_.reducedMotion != applied_.reducedMotion ||
        options_.stereo != applied_.stereo) {
        if (Status opened = openScene(); !opened) log::warn("{}", opened.error().message());
    }
    if (options_.headphones != applied_.headphones) openSound();
    config_.rules.assist = options_.assist; // from the next dive on
    applied_ = options_;
}

void Application::simulate() {
    GameSession& session = play_->session;
    const auto began = std::chrono::steady_clock::now();
    session.advance(play_->elapsed_s, !options_.record.empty());
    statistics_.sim_ms =
        std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began).count();
    const bool attended =
        display_->audience() == Audience::HeadsetPlayer || !play_->input || play_->input->focused;
    soundAndHaptics_->frame(session.shown, session.events, static_cast<float>(play_->elapsed_s), attended,
                            environment_->videoPosition_s());
    for (const game::Event& event : session.events)
        if (event.kind == game::EventKind::Catch) popups_.add(event, config_.species);
    popups_.advance(static_cast<float>(play_->elapsed_s));
    const auto dt_s = session.paused ? 0.0f : static_cast<float>(play_->elapsed_s);
    if (play_->states.mode() == Mode::Dive) play_->hints.follow(session.shown, session.events, dt_s);
    if (!play_->steps) return;
    play_->steps->follow(session.shown, dt_s);
    if (play_->steps->step() == FirstSteps::Step::Done) play_->stepsDone_s += dt_s;
}

Result<bool> Application::draw() {
    const game::Snapshot& shown = photo_ ? photo_->shown() : play_->session.shown;
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
                 if (photo_ && photoNotice_.empty()) return;
                 const gl::PassTimers::Scope scope(sceneRenderer_->timers(), "overlay");
                 drawHud(part, audience, view, size);
             }},
        shown, quality.scale);
    statistics_.draws = sceneRenderer_->drawCount();
    statistics_.triangles = sceneRenderer_->triangleCount();
    return drawn;
}

void Application::measure() {
    const bool first = play_->clock.frame() == 0;
    if (!first) statistics_.frame_ms.add(play_->clock.sinceBegin_ms());
    if (play_->freshVideo) {
        statistics_.light_ms.add(static_cast<double>(environment_->light_ms()));
        statistics_.decode_ms.add(static_cast<double>(environment_->decode_ms()));
        statistics_.upload_ms.add(static_cast<double>(environment_->upload_ms()));
    }
    const media::LivePlayer* live = environment_->live();
    if (!live) return;
    statistics_.live = live->counts();
    if (!play_->freshVideo || first) return;
    statistics_.liveLatency_ms.add(1e3 * live->age_s());
    statistics_.liveDisplayFrames.add(live->displayFrames());
}

TextOptions Application::textOptions() const {
    const TextSettings& text = options_.text;
    constexpr std::array kCaptionScales = {0.8f, 1.0f, 1.5f}; // by CaptionSize
    return {.language = languageIn(text),
            .scale = text.scale,
            .captionScale = kCaptionScales[static_cast<size_t>(text.captionSize)],
            .captionPanels = text.captionPanels,
            .highContrast = text.highContrast};
}

// What teaches: the first steps, or a hint.
void Application::drawTeaching(const Pen& pen, const render::View& view) {
    if (pen.audience == Audience::Onlooker) return;
    const auto say = [&](const char* text) {
        pen.label(pen.size.x / 2, pen.size.y * 0.14f, 0.5f, TextSize::Body, colour::kWhite, text);
    };
    if (play_->steps) {
        play_->steps->draw(pen, view);
        if (play_->stepsDone_s > 0) say(pen.in("Well caught! Now for real: 90 seconds"));
    } else if (const auto hint = play_->hints.shown())
        say(pen.in(*hint));
}

void Application::drawHud(HudPart part, Audience audience, const render::View& view, glm::ivec2 size) {
    const GameSession& session = play_->session;
    const ProgramStates& states = play_->states;
    const bool onHeadsetsEye = audience == Audience::HeadsetPlayer && part != HudPart::Panel;
    if (photo_) return hud_->drawNotice(photoNotice_, textOptions(), size);
    const std::string_view notice = environment_->notice();
    const auto* mouse = std::get_if<MouseSource>(&session.source);
    hud_->draw(
        {.part = part,
         .audience = audience == Audience::WindowPlayer && byGamepad_ ? Audience::GamepadPlayer : audience,
         .snapshot = &session.shown,
         .view = &view,
         .captions = options_.text.captions ? soundAndHaptics_->captions() : std::span<const game::Caption>(),
         .popups = popups_.shown(),
         .inDive = states.mode() != Mode::Title,
         .overlay =
             [&](const Pen& pen) {
                 if (!screens_.isOpen()) drawTeaching(pen, view);
                 screens_.draw(pen);
             },
         .text = textOptions(),
         .vignette = options_.vignette && mouse ? mouse->turning_radps() : 0.0f,
         .finger = menuControls_.finger(),
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
void Application::adjustQuality() {
    if (!quality_) return;
    glFinish();
    quality_->frame(play_->clock.sinceBegin_ms());
    environment_->setLightEvery(quality_->quality().lightEvery);
    statistics_.minScale = std::min(statistics_.minScale, quality_->quality().scale);
}

bool Application::isOver() const {
    if (!play_) return true;
    const GameSession& session = play_->session;
    if (session.ended) return true;
    if (options_.at_s) {
        const auto at_s = static_cast<double>(*options_.at_s);
        const double frames = at_s * static_cast<double>(options_.fps);
        if (session.shown.time_s >= at_s) return true;
        if (!window_ && static_cast<double>(play_->clock.frame()) >= frames) return true;
    }
    // Nobody is there to look at the results.
    return (!window_ || options_.timedemo) && std::holds_alternative<MouseSource>(session.source) &&
           play_->states.state() == ProgramStates::State::Results;
}

ImageRgb8 Application::pictureShown() const {
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
    return picture;
}

Status Application::saveScreenshot() const { return media::writePng(options_.screenshot, pictureShown()); }

} // namespace shoal::app
