// Application: the answers to the requests of the menu pages.
#include "game/app/Application.h"

#include "engine/core/Log.h"

#include <chrono>
#include <utility>
#include <variant>

namespace shoal::app {

Status Application::answer(const Request& request) {
    GameSession& session = play_->session;
    switch (request.kind) {
    case Request::Kind::Resume:
        session.paused = false;
        return Done{};
    case Request::Kind::Recentre:
        display_->recentre();
        return Done{};
    case Request::Kind::Restart:
        if (isForPerson() && session.dive.rules().stars != stars()) { // another dive, with other animals
            config_.seed = session.dive.seed() + 1;
            return begin(play_->states.mode());
        }
        session.restart = true;
        session.paused = false;
        play_->results_s = play_->resultsQuiet_s = 0;
        if (auto* mouse = std::get_if<MouseSource>(&session.source)) mouse->recentre();
        return Done{};
    case Request::Kind::Dive:
        return startDive(request.name, options_.firstSteps ? Mode::FirstSteps : Mode::Dive);
    case Request::Kind::SkipFirstSteps:
        return endFirstSteps();
    case Request::Kind::Swim:
        return startDive(request.name, Mode::FreeSwim);
    case Request::Kind::Title:
        return begin(Mode::Title);
    case Request::Kind::OpenFilm: {
        PlayOptions wanted = options_;
        wanted.environment.layer.clear();
        environment::setFile(wanted.environment, request.name);
        return reopen(wanted, Mode::Title, Screen::Films);
    }
    case Request::Kind::Headset:
        return startHeadset();
    case Request::Kind::Photo:
        photo_.emplace(session.shown, options_.fov_deg, byGamepad_, bindings_);
        screens_.close();
        return Done{};
    case Request::Kind::SettingsChanged:
        return applySettings();
    case Request::Kind::Quit:
        leaving_ = true;
    }
    return Done{};
}

Status Application::startDive(const std::string& name, Mode mode) {
    if (name != config_.dive.name) {
        PlayOptions wanted = options_;
        wanted.dive = name;
        return reopen(wanted, mode, Screen::Dives);
    }
    if (!options_.seed) config_.seed = drawnSeed();
    return begin(mode);
}

// Opens the headset, from the title screen or, after its loss, in mid-dive; the dive then goes on in it.
Status Application::startHeadset() {
    if (play_->states.mode() != Mode::Title) {
        if (Status entered = enterHeadset(); !entered) screens_.showError(entered.error().message());
        return Done{};
    }
    PlayOptions wanted = options_;
    wanted.xr = true;
    return reopen(wanted, Mode::Title, Screen::Title);
}

Status Application::enterHeadset() {
    options_.xr = true;
    if (Status opened = openDisplay(); !opened) {
        options_.xr = false;
        return opened;
    }
    askForHeadset_s_.reset();
    screens_.showError({});
    if (!std::holds_alternative<MouseSource>(play_->session.source)) return Done{};
    play_->session.source.emplace<OpenXrSource>();
    config_.handSource = {HandSourceKind::OpenXr, {}}; // for the next sessions too
    return Done{};
}

// Shows the room if the setting says so. If the headset cannot, the film stays and the player is told.
void Application::showRoom() {
    if (!display_->showRoom(options_.passthrough)) {
        log::warn("the headset's runtime cannot show your own room (it blends no pictures with it); the film "
                  "stays");
        options_.passthrough = false;
    }
    applied_.passthrough = options_.passthrough;
}

// Moves the dive to the window after the headset or its runtime has gone. The dive pauses; the player goes on
// with the mouse, or with the headset once it is back.
void Application::leaveHeadset(const Error& why) {
    log::warn("{}", why.message());
    options_.xr = false;
    if (options_.hands.source == "openxr") options_.hands.source.clear();
    (void)openDisplay(); // in the window, which does not fail
    GameSession& session = play_->session;
    if (std::holds_alternative<OpenXrSource>(session.source)) {
        session.source.emplace<MouseSource>(config_.rig, config_.species);
        config_.handSource = {HandSourceKind::Mouse, {}};
    }
    session.head.reset(); // only a headset feeds it
    session.paused = true;
    screens_.facts.headsetLost = true;
    askForHeadset_s_ = kAskEvery_s; // a runtime that shuts down still answers for a while
    play_->states.update();
    screens_.showError(why.message());
}

// Reopens a lost headset once it is back, unless the dive goes on without it. The runtime may take seconds to
// answer, so a thread of its own asks it.
void Application::awaitHeadset() {
    if (photo_ || !askForHeadset_s_) return;
    if (play_->states.state() != ProgramStates::State::Paused) return askForHeadset_s_.reset();
    if (headsetAnswer_.valid()) {
        if (headsetAnswer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
        askForHeadset_s_ = kAskEvery_s;
        if (!headsetAnswer_.get()) return;
        if (Status entered = enterHeadset(); !entered) log::debug("{}", entered.error().message());
        return;
    }
    *askForHeadset_s_ -= play_->dt_s();
    if (*askForHeadset_s_ <= 0) headsetAnswer_ = std::async(std::launch::async, &xr::Headset::isThere);
}

// Begins the dive after the first steps, which later dives leave out.
Status Application::endFirstSteps() {
    options_.firstSteps = false;
    screens_.keep("first-steps");
    return begin(Mode::Dive);
}

Status Application::reopen(const PlayOptions& wanted, Mode mode, Screen asker) {
    if (Status ended = endPlay(); !ended) return ended;
    const PlayOptions before = std::exchange(options_, wanted);
    const Status opened = openContent();
    return opened ? begin(mode) : goBack(before, opened.error(), asker);
}

Status Application::openContent() {
    if (Status s = makeSessionConfig(options_).moveTo(config_); !s) return s;
    if (options_.xr != inHeadset())
        if (Status s = openDisplay(); !s) return s;
    if (Status s = openScene(); !s) return s;
    openSound();
    applied_ = options_;
    return Done{};
}

// Restores the earlier options and content, and shows the error on the page that made the request.
Status Application::goBack(const PlayOptions& before, const Error& why, Screen asker) {
    if (leaving_) return Done{};
    log::warn("{}", why.message());
    options_ = before;
    if (Status back = openContent(); !back) { // the earlier film may be gone: opens the dive's own
        options_.environment = PlayOptions().environment;
        if (Status own = openContent(); !own) return own;
    }
    if (Status begun = begin(Mode::Title); !begun) return begun;
    screens_.openWithError(asker, why.message());
    return Done{};
}

// Applies settings that are not read in every frame.
Status Application::applySettings() {
    if (options_.fullscreen != applied_.fullscreen) window_->toggleFullscreen();
    if (options_.passthrough != applied_.passthrough) {
        showRoom();
        if (!options_.passthrough) screens_.keep("passthrough"); // saves that the room could not be shown
    }
    if (options_.quality == QualityControl::Fixed) quality_.reset();
    if (Status opened = openScene(); !opened) return goBack(applied_, opened.error(), Screen::Title);
    // A sound or haptic output that was opened silent must be opened again to become louder.
    const auto starts = [](float before, float now) { return before == 0 && now > 0; };
    if (options_.headphones != applied_.headphones || starts(applied_.videoSound, options_.videoSound) ||
        starts(applied_.hapticStrength, options_.hapticStrength))
        openSound();
    if (play_->session.tracked) play_->session.tracked->setHandSize(options_.hands.size);
    config_.hands.size = options_.hands.size;
    if (options_.hands.source != applied_.hands.source) {
        if (const auto chosen = handSourceFor(options_)) {
            config_.handSource = *chosen;
            play_->session.track(config_);
        } else {
            screens_.showError(chosen.error().message());
        }
    }
    config_.rules.assist = options_.assist; // takes effect with the next dive
    applied_ = options_;
    return Done{};
}

} // namespace shoal::app
