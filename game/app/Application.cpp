// Opening of the application, and the frames of the title screen and of dives.
#include "game/app/Application.h"

#include "engine/core/Log.h"
#include "engine/gl/Renderer.h"
#include "engine/media/Pictures.h"
#include "game/settings/KeptFiles.h"
#include "game/tools/Commands.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>
#include <variant>

namespace shoal::app {

constexpr float kTitleTurn_radps = 0.03f; // rate at which the view behind the title turns
constexpr float kGoalsAtFirst_s = 8;      // time for which the goals are shown as a dive begins
constexpr float kGoalsOnNews_s = 4;       // time for which they are shown after one is reached
constexpr float kResultsRest_s = 1;       // time without a press before the results accept a choice
constexpr float kMaxResultsRest_s = 3;    // limit of that wait
constexpr float kMet_s = 4;               // time for which a new animal in the field guide is named
constexpr float kPhotoFiner = 2;          // a saved picture's pixels are means of 2 x 2 drawn ones
// Eye height above the floor that tells tall people who sit from small people who stand.
constexpr float kStandingEyes_m = 1.35f;
constexpr double kHiddenPeriod_s = 0.25; // time between polls of a minimised window's input
// Time between pictures behind a menu, and while nothing has been pressed for some time.
constexpr double kMenuPeriod_s = 1 / 30.0, kQuietPeriod_s = 1 / 15.0;
constexpr float kQuietAfter_s = 20;
constexpr double kWarmUp_s = 5; // length of the warm-up dive before a measured one

// Returns the dives with their titles; a dive whose file cannot be read is left out.
static std::vector<DiveName> divesThereAre() {
    std::vector<DiveName> dives;
    for (const std::string& name : game::diveNames()) {
        const auto files = game::loadDiveFiles(name);
        if (!files) {
            log::warn("{}", files.error().message());
            continue;
        }
        const std::string picture = "dives/" + name + ".jpg";
        const bool shown = std::filesystem::exists(dataRoot() / "content" / picture);
        dives.push_back({.name = name, .title = files->dive.title, .picture = shown ? picture : ""});
        for (const game::School& school : files->dive.schools)
            if (school.stars > 0)
                dives.back().rare.emplace_back(files->species[school.species].name, school.stars);
    }
    // The default dive comes first.
    const auto first = std::ranges::find(dives, kFirstDive, &DiveName::name);
    if (first != dives.end()) std::rotate(dives.begin(), first, first + 1);
    return dives;
}

Application::Application(const PlayOptions& options) : options_(options), applied_(options) {
    if (!bindings_.parse(options.controls.bindings))
        log::warn("settings: \"bindings\" cannot be read; keys and buttons are as at first");
}

Status Application::open() {
    if (Status s = makeSessionConfig(options_).moveTo(config_); !s) return s;
    if (Status opened = openContext(); !opened) return opened;
    statistics_.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    gl::spreadRasterThreads();
    // The display is opened before the slower parts, because a headset is the most likely to fail.
    if (Status opened = openDisplay(); !opened) return opened;
    screens_.facts = {.species = &config_.species,
                      .dive = &config_.dive,
                      .dives = divesThereAre(),
                      .headset = xr::Headset::hasRuntime(),
                      .allScores = readScores(),
                      .met = readGuide()};
    if (Status opened = openScene(); !opened) return opened;
    openSound();
    if (!window_) return Done{};
    const auto icon = readSmallPicture(dataRoot() / "content/icon.png");
    icon ? window_->setIcon(*icon) : log::warn("{}", icon.error().message());
    return Done{};
}

void Application::openSound() {
    const environment::Player& film = content_.environment().player();
    // Another film may have music of its own.
    const std::string music = options_.environment.isOwnVideo() ? config_.dive.music : "";
    soundAndHaptics_.emplace(options_, music, film.file(), film.length_s());
}

Status Application::openContext() {
    Status opened = options_.headless
                        ? platform::Headless::open().moveTo(headless_)
                        : platform::Window::open({"Shoal", options_.look.size.x, options_.look.size.y,
                                                  options_.fullscreen,
                                                  options_.vsync && !options_.timedemo && !options_.xr})
                              .moveTo(window_);
    if (opened) opened = Hud::make().moveTo(hud_);
    if (opened) drawLoading(0); // instead of a black window
    return opened;
}

Status Application::openDisplay() {
    const int samples = gl::defaultSamples();
    quality_.reset(); // another display may have another refresh rate
    const bool vsync = options_.vsync && !options_.timedemo;
    if (!options_.xr) {
        if (window_) window_->setVsync(vsync);
        display_ = std::make_unique<FlatDisplay>(window_ ? &*window_ : nullptr, options_, samples);
        return Done{};
    }
    if (headsetAnswer_.valid()) headsetAnswer_.get(); // the runtime is not asked twice at a time
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
    leaving_ |= input.closing || stopSignal != 0;
    const glm::ivec2 size = window_->framebufferSize();
    if (!hud_ || size.x <= 0 || size.y <= 0) return !leaving_;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    glClearColor(0.02f, 0.11f, 0.16f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    if (content_.hasPicture()) {
        const game::Snapshot nothing;
        content_.renderer().set(nothing, content_.environment(), look());
        const auto hud = [&](HudPart, Audience, const render::View&, glm::ivec2 eye) {
            hud_->drawLoading(progress, options_.text, eye);
        };
        if (display_->draw({content_.renderer(), hud}, nothing, 1)) display_->present();
    } else {
        hud_->drawLoading(progress, options_.text, size);
        window_->present();
    }
    return !leaving_;
}

Status Application::openScene() {
    const bool filmFirst = window_ && !options_.xr && options_.environment.isOwnVideo();
    return content_.open(options_, config_, display_->seesRoom(), filmFirst);
}

Status Application::run(bool measured) {
    measured_ = measured;
    if (Status begun = begin(firstMode()); !begun) return begun;
    Status played = Done{};
    while (!leaving_ && played) {
        played = frame();
        if (!played && display_->lost() && play_->states.byPerson()) {
            leaveHeadset(played.error());
            played = Done{};
        }
        if (!played) break;
        if (played = beginAsTracked(); !played) break;
        if (const auto request = screens_.takeRequest()) played = answer(*request);
        if (!play_ || play_->isOver()) break; // play_ is empty if the player left while a film was loading
        awaitHeadset();
        if (!measured_ && play_->session.shown.time_s >= kWarmUp_s) break;
        if (played && play_->tutorial.stepsAreOver()) played = endFirstSteps();
    }
    const Status ended = endPlay(); // even after an error
    return played ? ended : played;
}

// Returns the mode to begin with: the title screen, if a person plays who has not asked for another.
Mode Application::firstMode() const {
    const bool watched = window_ && !options_.timedemo && !options_.at_s && options_.record.empty();
    const bool asked = options_.start == Start::Dive || options_.freeSwim || !options_.dive.empty();
    const bool title = options_.start == Start::Title || (options_.start == Start::Auto && !asked);
    if (isForPerson() && watched && title) return Mode::Title;
    return options_.freeSwim ? Mode::FreeSwim : Mode::Dive;
}

Status Application::begin(Mode mode) {
    if (Status ended = endPlay(); !ended) return ended;
    SessionConfig config = config_;
    if (isForPerson()) {
        config.rules.freeSwim = mode != Mode::Dive;
        config.rules.seated = isSeated();
        config.rules.roomFloor_cm = roomFloor_cm();
        config.rules.stars = stars();
    }
    statistics_ = {.renderer = std::move(statistics_.renderer)};
    const FrameClock::Mode clock = options_.timedemo ? FrameClock::Mode::TimeDemo
                                   : window_         ? FrameClock::Mode::RealTime
                                                     : FrameClock::Mode::FixedStep;
    play_.emplace(config, options_, clock, screens_, mode);
    return records(mode) ? play_->session.record(recordingFile()) : Done{};
}

// Returns the player's stars; none without a window, where equal commands give equal pictures.
int Application::stars() const { return config_.live ? starsIn(screens_.facts.allScores) : 0; }

bool Application::isSeated() const {
    if (!inHeadset()) return false;
    if (options_.posture != Posture::Auto) return options_.posture == Posture::Seated;
    const std::optional<float> eyes_m = display_->eyesAboveFloor_m();
    return eyes_m && *eyes_m < kStandingEyes_m;
}

int Application::roomFloor_cm() const {
    constexpr long kNearest_cm = 70; // below the animals
    const std::optional<float> floor_m = display_->roomFloor_m();
    return floor_m ? static_cast<int>(
                         std::clamp(std::lround(-100 * *floor_m), kNearest_cm, long{game::kDeepest_cm}))
                   : 0;
}

// A headset knows the heights of eyes and floor only after the first dive has been set up.
Status Application::beginAsTracked() {
    constexpr uint64_t kFirst_ticks = 60; // half a second
    const GameSession& session = play_->session;
    const game::DiveRules& rules = session.dive.rules();
    const bool changed = (!rules.seated && isSeated()) || (rules.roomFloor_cm == 0 && roomFloor_cm() > 0);
    if (!isForPerson() || session.ticks > kFirst_ticks || !changed) return Done{};
    const Mode mode = play_->states.mode();
    if (records(mode)) --recordings_; // the recording begins again, too
    return begin(mode);
}

// Each session has a recording of its own: FILE, FILE-2, FILE-3.
Path Application::recordingFile() {
    Path file = options_.record;
    if (++recordings_ > 1)
        file.replace_filename(file.stem().string() + "-" + std::to_string(recordings_) +
                              file.extension().string());
    return file;
}

Status Application::endPlay() {
    if (!play_) return Done{};
    const Status verdict = play_->end(statistics_);
    play_.reset();
    return verdict;
}

Status Application::frame() {
    if (Status begun = display_->begin(); !begun) return begun;
    GameSession& session = play_->session;
    play_->beginFrame(display_->elapsed_s());
    content_.renderer().timers().beginFrame(options_.frameTimes);
    PartTimes* const parts = &content_.renderer().timers().onThread();
    timed(parts, "input", [&] { readInput(); });
    timed(parts, "ticks and sound", [&] { simulate(); });
    noteTracker();
    measureHand();
    if (Status done = display_->vibrate(soundAndHaptics_->hapticFrame(), session.paused); !done) return done;
    const size_t metBefore = screens_.facts.met.size();
    play_->states.update();
    noteMet(metBefore);
    // The video starts, pauses and restarts with the dive.
    play_->freshVideo = timed(parts, "film", [&] {
        return content_.environment().update(play_->clock.video_s(session.shown.time_s),
                                             play_->clock.exactVideo());
    });
    const bool hidden = window_ && !options_.timedemo && play_->controls.input.minimised && !inHeadset();
    pace_.begin();
    const Result<bool> drawn = hidden ? Result<bool>(false) : draw();
    if (!drawn) return drawn.error();
    if (*drawn && quality_) { // adapts it before waiting for the display
        quality_->frame(std::max(play_->clock.sinceBegin_ms(), pace_.card_ms()));
        content_.environment().setLightEvery(quality_->quality().lightEvery);
        statistics_.minScale = std::min(statistics_.minScale, quality_->quality().scale);
    }
    timed(parts, "display and card", [&] {
        if (*drawn) display_->present();
        pace_.end(content_.environment().player().live() != nullptr); // its latency is measured
    });
    measure();
    rest(hidden);
    if (measured_ && content_.environment().player().live()) play_->clock.waitForLiveVideo();
    return Done{};
}

// Waits for the next picture's time, if the display has not; a menu answers input at once.
void Application::rest(bool hidden) {
    if (!window_ || options_.timedemo || inHeadset()) return;
    const bool menu = play_->states.byPerson() && play_->states.state() != ProgramStates::State::Diving;
    const std::optional<TrackedHands>& tracked = play_->session.tracked;
    const bool quiet = quiet_s_ > kQuietAfter_s && !(tracked && tracked->moveHands());
    // Displays that wait are a little late at times: then this wait must not cost the next picture.
    constexpr double kEarly = 0.9;
    const double period_s = hidden           ? kHiddenPeriod_s
                            : menu           ? (quiet ? kQuietPeriod_s : kMenuPeriod_s)
                            : options_.vsync ? kEarly * display_->period_s()
                                             : 0;
    const double left_s = period_s - 1e-3 * play_->clock.sinceBegin_ms();
    if (left_s <= 0) return;
    if (hidden || menu)
        window_->wait(left_s);
    else
        std::this_thread::sleep_for(std::chrono::duration<double>(left_s));
}

void Application::readInput() {
    GameSession& session = play_->session;
    ProgramStates& states = play_->states;
    leaving_ |= display_->leaving() || stopSignal != 0;
    if (window_) {
        const platform::WindowInput& input = play_->controls.input;
        play_->controls = readControls(*window_, bindings_);
        leaving_ |= input.closing;
        noteDevice();
        const bool menus = screens_.isOpen();
        globalActions(play_->controls);
        if (photo_) {
            window_->holdCursor(input.rightButton);
            return photograph();
        }
        // In a headset the window's focus does not matter: the headset reports whether it is worn.
        const bool windowPlayer = display_->audience() == Audience::WindowPlayer;
        if (!menus || !states.byPerson())
            states.input(play_->controls, windowPlayer && !input.focused, leaving_);
        if (menus && states.byPerson()) readMenuInput();
        for (const std::string& file : input.droppedFiles)
            if (states.byPerson()) screens_.dropped(file);
    }
    display_->feed(session);
    // A script in a headset stands still while the session is paused: it waits for somebody to watch.
    if (inHeadset() && session.paused && !states.byPerson()) play_->elapsed_s = 0;
    auto* mouse = std::get_if<MouseSource>(&session.source);
    if (!mouse) return;
    if (states.state() == ProgramStates::State::Title)
        return mouse->idle(play_->dt_s(), options_.reducedMotion ? 0.0f : kTitleTurn_radps);
    if (window_) window_->holdCursor(!screens_.isOpen() && play_->controls.input.rightButton);
    if (screens_.isOpen()) return mouse->release();
    play_->moveMouse(window_ ? &play_->controls : nullptr,
                     window_ ? window_->framebufferSize() : options_.look.size);
}

// Notes whether the player uses the gamepad; the texts on the screen suit that device.
void Application::noteDevice() {
    const platform::WindowInput& input = play_->controls.input;
    const platform::Gamepad& pad = input.gamepad;
    const bool byHand = !input.keysPressed.empty() || input.leftPressed || input.cursorMoved != glm::dvec2(0);
    const bool byPad =
        !pad.pressed.empty() || pad.leftStick != glm::vec2(0) || pad.rightStick != glm::vec2(0);
    if (byHand || byPad) byGamepad_ = byPad;
    quiet_s_ = byHand || byPad ? 0 : quiet_s_ + play_->dt_s();
}

void Application::readMenuInput() {
    const platform::WindowInput& input = play_->controls.input;
    if (screens_.capturesKey()) return screens_.capture(input);
    // A hand held up to be measured does not poke the menu.
    const auto fingers =
        screens_.top() == Screen::HandSize ? std::array<Pointing, 2>() : display_->pointing(play_->session);
    MenuInput menu = menuControls_.step(input, &*window_, fingers, display_->menuSurface(), play_->dt_s());
    // A press meant for a fish as the dive ends must choose nothing in the results.
    if (play_->states.state() == ProgramStates::State::Results) {
        const bool rests = play_->results_s < kMaxResultsRest_s && play_->resultsQuiet_s < kResultsRest_s;
        play_->results_s += play_->dt_s();
        play_->resultsQuiet_s = menu.accept || menu.pressed ? 0 : play_->resultsQuiet_s + play_->dt_s();
        if (rests) menu.accept = menu.pressed = menu.back = false;
    }
    screens_.input(menu);
}

void Application::noteTracker() {
    const std::optional<TrackedHands>& tracked = play_->session.tracked;
    ScreenFacts& facts = screens_.facts;
    const bool webcam = tracked && tracked->hasCamera();
    const auto need = tracked ? tracked->needs() : std::nullopt;
    if (facts.webcam == webcam && facts.handsNeed == need) return;
    facts.webcam = webcam;
    facts.handsNeed = need;
    screens_.refresh();
}

// Announces a new animal in the field guide. before: number of animals in it before this frame.
void Application::noteMet(size_t before) {
    const std::vector<MetAnimal>& met = screens_.facts.met;
    play_->metLeft_s -= play_->dt_s();
    if (met.size() == before) return;
    const game::SpeciesTable& all = *screens_.facts.species;
    play_->met = game::Notice{
        "New in your field guide: {}",
        animalName(all[game::findSpecies(all, met.back().species)], 1, options_.text.shownLanguage())};
    play_->metLeft_s = kMet_s;
}

// Measures the hand while the page HandSize is open, each time from the start.
void Application::measureHand() {
    ScreenFacts& facts = screens_.facts;
    if (screens_.top() != Screen::HandSize) {
        facts.handSizing = {};
        return;
    }
    if (facts.handSizing.size()) return;
    const std::optional<TrackedHands>& tracked = play_->session.tracked;
    facts.handSizing.see(tracked ? tracked->openHand_m() : std::nullopt, play_->dt_s());
    if (const auto size = facts.handSizing.size()) {
        options_.hands.size = *size;
        screens_.keep("hand-size");
    }
    screens_.refresh();
}

// Handles the actions that do the same in every state.
void Application::globalActions(const Controls& controls) {
    if (screens_.capturesKey()) return;
    const auto toggle = [&](Action action, bool& setting, std::string_view key) {
        if (!controls.wasPressed(action)) return;
        setting = !setting;
        screens_.keep(key);
    };
    toggle(Action::Performance, options_.frameTimes, "frame-times");
    toggle(Action::Fullscreen, options_.fullscreen, "fullscreen");
#ifndef NDEBUG
    for (const int key : play_->controls.input.keysPressed)
        if (key == GLFW_KEY_F5)
            if (Status reloaded = content_.renderer().reloadShaders(); !reloaded)
                log::warn("{}", reloaded.error().message());
#endif
    if (controls.wasPressed(Action::Recentre)) display_->recentre();
    if (inHeadset()) toggle(Action::Room, options_.passthrough, "passthrough");
    const int louder = controls.wasPressed(Action::Louder) - controls.wasPressed(Action::Quieter);
    if (louder != 0 && !options_.mute) {
        options_.volume = std::clamp(options_.volume + 0.1f * static_cast<float>(louder), 0.0f, 1.0f);
        volumeShown_s_ = glfwGetTime();
        screens_.keep("volume");
    }
}

void Application::photograph() {
    const auto command =
        photo_->step(play_->controls, options_.controls.sensitivity, play_->dt_s(), options_.fov_deg);
    if (command == PhotoMode::Command::Picture) {
        photo_->notice.reset(); // no text covers the picture
        const Result<bool> drawn = draw(kPhotoFiner);
        if (drawn && *drawn) photo_->save(pictureOf(display_->pictures()), content_.renderer());
    } else if (command == PhotoMode::Command::Leave) {
        options_.fov_deg = photo_->fovBefore_deg;
        photo_.reset();
        screens_.open(Screen::Paused, screens_.menu().focus()); // where it was left
    }
}

void Application::simulate() {
    GameSession& session = play_->session;
    const double began_ms = play_->clock.sinceBegin_ms();
    session.advance(play_->elapsed_s);
    statistics_.sim_ms = static_cast<float>(play_->clock.sinceBegin_ms() - began_ms);
    const bool attended = inHeadset() || play_->controls.input.focused;
    soundAndHaptics_->frame(session.shown, session.events, play_->dt_s(), attended,
                            content_.environment().player().videoPosition_s(),
                            glm::quat_cast(glm::transpose(content_.environment().envFromWorld())));
    const auto dt_s = session.paused ? 0.0f : play_->dt_s();
    play_->goalsLeft_s -= dt_s;
    for (const game::Event& event : session.events) {
        if (event.species >= 0 && event.position && play_->popups.size() < play_->popups.capacity()) {
            const game::Species& kind = config_.species[event.species];
            const bool longest =
                event.length_m >= session.after.tally[event.species].largest_m; // of the dive
            play_->popups.push_back({event.points, event.combo, &kind, *event.position, event.length_m,
                                     event.mass_kg, longest && screens_.isRecord(kind, event.length_m)});
        }
        if (event.kind == game::EventKind::Goal) play_->goalsLeft_s = kGoalsOnNews_s;
    }
    for (Popup& popup : play_->popups) popup.age_s += play_->dt_s();
    std::erase_if(play_->popups, [](const Popup& popup) { return popup.age_s > Popup::kStay_s; });
    play_->tutorial.follow(session.shown, session.events, dt_s);
}

const game::Snapshot& Application::shown() {
    if (photo_) return photo_->shown;
    const game::Snapshot& dive = play_->session.shown;
    const auto animal = screens_.animalBeside();
    const auto extent = animal ? content_.loadSpecies(config_, *animal) : std::nullopt;
    if (!extent) return dive;
    return guideAnimal_.show(dive, static_cast<int>(*animal), config_.species[*animal], *extent,
                             halfExtentOf(display_->menuSurface().size, options_.fov_deg), play_->dt_s(),
                             !options_.reducedMotion);
}

Look Application::look() const {
    return {.exposure = content_.environment().exposure(options_.look.tone, options_.look.exposure_ev),
            .glossy = options_.look.glossy,
            .particles = options_.snow && !options_.reducedMotion,
            .lamp = config_.dive.lamp,
            .player = photo_ ? std::optional(photo_->player) : std::nullopt};
}

Result<bool> Application::draw(float finer) {
    const game::Snapshot& shown = this->shown();
    const bool wantsQuality = options_.quality == QualityControl::Auto && window_ && !options_.timedemo;
    if (wantsQuality && !quality_ && display_->period_s() > 0) quality_.emplace(1000 * display_->period_s());
    const Quality quality = quality_ ? quality_->quality() : Quality();
    content_.renderer().set(shown, content_.environment(), look());
    const auto hud = [&](HudPart part, Audience audience, const render::View& view, glm::ivec2 size) {
        if (options_.look.skip == render::SkippedPass::Overlay || (photo_ && !photo_->notice)) return;
        const gl::PassTimers::Scope scope(&content_.renderer().timers(), "overlay");
        drawHud(part, audience, view, size);
    };
    const Result<bool> drawn =
        display_->draw({content_.renderer(), hud}, shown, finer > 1 ? finer : quality.scale);
    statistics_.draws = content_.renderer().drawCount();
    statistics_.triangles = content_.renderer().triangleCount();
    return drawn;
}

void Application::measure() {
    const bool first = play_->clock.frame() == 0;
    if (!first) {
        for (const PartTimes::Time& time : content_.renderer().timers().onThread().times())
            statistics_.addPart(time.part, time.ms);
        statistics_.frame_ms.push_back(static_cast<float>(play_->clock.sinceBegin_ms()));
    }
    if (play_->freshVideo) {
        statistics_.light_ms.push_back(content_.environment().player().light_ms());
        statistics_.decode_ms.push_back(content_.environment().player().decode_ms());
        statistics_.upload_ms.push_back(content_.environment().upload_ms());
    }
    const media::LivePlayer* live = content_.environment().player().live();
    if (!live) return;
    statistics_.live = live->counts();
    if (!play_->freshVideo || first) return;
    statistics_.liveLatency_ms.push_back(static_cast<float>(1e3 * live->age_s()));
    statistics_.liveDisplayFrames.push_back(static_cast<float>(live->displayFrames()));
}

void Application::drawHud(HudPart part, Audience audience, const render::View& view, glm::ivec2 size) {
    GameSession& session = play_->session;
    const ProgramStates& states = play_->states;
    const bool showTimes = options_.frameTimes && part != HudPart::Marks;
    const bool showVolume = window_ && glfwGetTime() - volumeShown_s_ < 1.5;
    const bool showCamera = session.tracked && (showTimes || screens_.showsCamera());
    if (showCamera && session.tracked->look(cameraImage_)) cameraPicture_.show(cameraImage_);
    if (photo_) return hud_->drawNotice(*photo_->notice, options_.text, size);
    const game::Notice* notice = display_->notice();
    if (!notice) notice = content_.environment().notice();
    if (!notice && session.tracked) notice = session.tracked->notice();
    if (!notice && play_->metLeft_s > 0) notice = &*play_->met;
    const auto* mouse = std::get_if<MouseSource>(&session.source);
    std::vector<std::string> goals;
    const bool goalsAreNews =
        session.shown.time_s < static_cast<double>(kGoalsAtFirst_s) || play_->goalsLeft_s > 0;
    if (goalsAreNews && !screens_.isOpen()) goals = screens_.goalLines(session.shown.goals);
    hud_->draw(
        {.part = part,
         .audience = audience == Audience::WindowPlayer && byGamepad_ ? Audience::GamepadPlayer : audience,
         .snapshot = &session.shown,
         .view = &view,
         .captions = options_.text.captions ? soundAndHaptics_->captions() : std::span<const game::Caption>(),
         .popups = play_->popups,
         .goals = goals,
         .inDive = states.mode() != Mode::Title,
         .overlay =
             [&](const Pen& pen) {
                 if (!screens_.isOpen()) play_->tutorial.draw(pen, view);
                 screens_.draw(pen);
             },
         .text = options_.text,
         .vignette = options_.vignette && mouse ? mouse->turning_radps() : 0.0f,
         .finger = menuControls_.finger(),
         .statistics = showTimes ? &statistics_ : nullptr,
         .quality = quality_ ? quality_->quality() : Quality(),
         .passes = content_.renderer().timers().times(),
         .environment = &content_.environment(),
         .camera = showCamera && cameraPicture_.texture ? &cameraPicture_ : nullptr,
         .notice = notice,
         .volume = showVolume ? std::optional(options_.volume) : std::nullopt},
        size);
}

Status Application::saveScreenshot() const {
    return media::writePng(options_.screenshot, pictureOf(display_->pictures()));
}

} // namespace shoal::app
