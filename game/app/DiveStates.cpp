#include "game/app/DiveStates.h"

#include "engine/core/Log.h"
#include "game/settings/KeptFiles.h"

#include <GLFW/glfw3.h>

#include <array>
#include <variant>

namespace shoal::app {

namespace {

constexpr float kHintTime_s = 7;
constexpr std::array kHeadsetHints = {
    "Reach for a fish and close your hand on it",
    "Hold it for a second",
    "Keep what you hold away from the shark",
};
constexpr std::array kMouseHints = {
    "Reach with the mouse; the wheel reaches nearer or farther",
    "Hold the left button to close your hand on a fish; hold it for a second",
    "Look around with the arrow keys or the right button.  Tab swaps hands",
    "Keep what you hold away from the shark.  Esc pauses",
};

void drawPause(const Pen& pen) {
    constexpr std::array kHeadset = {"Close a hand: go on", "Your headset's own menu: leave"};
    constexpr std::array kWindow = {"Esc or P: go on",   "Q: leave",       "R: start again",
                                    "F11: whole screen", "+ and -: sound", "F1: frame times"};
    const bool headset = pen.audience == Audience::HeadsetPlayer;
    if (!headset) pen.shade();
    const float height = headset ? 7 : 12.5f;
    pen.panel(21, height);
    const float y = pen.size.y / 2 - pen.line * (height / 2 - 0.65f);
    pen.text(pen.size.x / 2, y, 0.5f, 1.4f, colour::kWhite, "Paused");
    pen.lines(y + pen.line * 2.4f, headset ? std::span<const char* const>(kHeadset) : kWindow);
}

} // namespace

DiveStates::State DiveStates::state() const {
    if (session_.after.phase == game::Phase::Results) return State::Results;
    // As the player or the headset has decided, or the script or replay that plays.
    return (byPerson() ? session_.paused : session_.after.paused) ? State::Paused : State::Diving;
}

void DiveStates::input(const platform::WindowInput& input, bool pausesWithoutFocus) {
    if (pausesWithoutFocus && !input.focused && state() == State::Diving && byPerson())
        session_.paused = true;
    for (const int key : input.keysPressed) keyPressed(key);
    session_.restart |= input.leftPressed && state() == State::Results;
    if (session_.restart) session_.paused = false;
}

void DiveStates::keyPressed(int key) {
    const bool escape = key == GLFW_KEY_ESCAPE, pauses = escape || key == GLFW_KEY_P;
    switch (state()) {
    case State::Diving:
        if (pauses && byPerson())
            session_.paused = true;
        else
            leaving_ |= escape; // a script or replay cannot be paused
        break;
    case State::Paused:
        leaving_ |= byPerson() ? key == GLFW_KEY_Q : escape;
        if (!byPerson()) break; // the script or replay has paused, and goes on by itself
        session_.restart |= key == GLFW_KEY_R;
        if (pauses || session_.restart) session_.paused = false;
        break;
    case State::Results:
        leaving_ |= escape || key == GLFW_KEY_Q;
        session_.restart |= key == GLFW_KEY_R || key == GLFW_KEY_ENTER;
        if (key == GLFW_KEY_P) session_.paused = false;
        break;
    }
}

void DiveStates::update() {
    const bool ended = state() == State::Results && !over_;
    over_ = state() == State::Results;
    if (!ended) return;
    newBest_ = session_.after.score > bestScore_;
    if (!newBest_) return;
    bestScore_ = session_.after.score;
    // Only what a person has played counts.
    if (keepsScores_ && byPerson())
        if (Status saved = saveBestScore(diveName_, bestScore_); !saved)
            log::warn("{}", saved.error().message());
}

void DiveStates::drawOverlay(const Pen& pen) const {
    switch (state()) {
    case State::Diving:
        return drawHints(pen);
    case State::Paused:
        return drawPause(pen);
    case State::Results:
        return drawResults(pen);
    }
}

void DiveStates::drawHints(const Pen& pen) const {
    const auto* mouse = std::get_if<MouseSource>(&session_.source);
    const bool unused = mouse ? !mouse->used() : byPerson() && session_.shown.caught == 0;
    if (!unused || session_.shown.time_s >= kHintTime_s || pen.audience == Audience::Onlooker) return;
    pen.lines(pen.size.y * 0.24f, pen.audience == Audience::HeadsetPlayer
                                      ? std::span<const char* const>(kHeadsetHints)
                                      : kMouseHints);
}

void DiveStates::drawResults(const Pen& pen) const {
    const game::Snapshot& s = session_.shown;
    pen.panel(22, 13);
    const float x = pen.size.x / 2;
    float y = pen.size.y / 2 - pen.line * 5.6f;
    pen.text(x, y, 0.5f, 1.4f, colour::kWhite, "The dive is over");
    pen.text(x, y += pen.line * 2.0f, 0.5f, 2.6f, colour::kGold, std::to_string(s.score));
    pen.text(x, y += pen.line * 3.2f, 0.5f, 0.9f, colour::kWhite,
             fmt::format("{} fish caught, {} taken by the shark", s.caught, s.lost));
    pen.text(x, y += pen.line * 1.4f, 0.5f, 0.9f, newBest_ ? colour::kOrange : colour::kDim,
             newBest_ ? "Your best dive yet" : fmt::format("Your best: {}", bestScore_));
    pen.text(x, y + pen.line * 2.4f, 0.5f, 0.85f, colour::kWhite,
             pen.audience == Audience::HeadsetPlayer ? "Close both hands: dive again"
                                                     : "Enter or a click: dive again      Esc: leave");
}

} // namespace shoal::app
