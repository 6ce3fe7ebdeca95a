#include "game/app/states/DiveStates.h"

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

} // namespace

ProgramState::Next DivingState::keyPressed(StateContext& context, int key) {
    if (key != GLFW_KEY_ESCAPE && key != GLFW_KEY_P) return {};
    if (context.byPerson()) return focusLost(context);
    context.leaving |= key == GLFW_KEY_ESCAPE; // a script or replay cannot be paused
    return {};
}

ProgramState::Next DivingState::focusLost(StateContext& context) {
    if (!context.byPerson()) return {};
    context.session.paused = true;
    return std::make_unique<PausedState>();
}

ProgramState::Next DivingState::update(StateContext& context) {
    if (context.showsResults()) return std::make_unique<ResultsState>(context);
    if (context.paused()) return std::make_unique<PausedState>();
    return {};
}

void DivingState::drawOverlay(const StateContext& context, const Pen& pen) const {
    const GameSession& session = context.session;
    const auto* mouse = std::get_if<MouseSource>(&session.source);
    const bool unused = mouse ? !mouse->used() : context.byPerson() && session.shown.caught == 0;
    if (!unused || session.shown.time_s >= kHintTime_s || pen.audience == Audience::Onlooker) return;
    pen.lines(pen.size.y * 0.24f, pen.audience == Audience::HeadsetPlayer
                                      ? std::span<const char* const>(kHeadsetHints)
                                      : kMouseHints);
}

ProgramState::Next PausedState::keyPressed(StateContext& context, int key) {
    const bool toggles = key == GLFW_KEY_ESCAPE || key == GLFW_KEY_P;
    if (!context.byPerson()) {
        context.leaving |= key == GLFW_KEY_ESCAPE; // the script or replay has paused, and goes on by itself
        return {};
    }
    context.leaving |= key == GLFW_KEY_Q;
    if (key == GLFW_KEY_R) context.restart();
    if (!toggles && key != GLFW_KEY_R) return {};
    context.session.paused = false;
    return std::make_unique<DivingState>();
}

ProgramState::Next PausedState::update(StateContext& context) {
    if (context.showsResults()) return std::make_unique<ResultsState>(context);
    if (!context.paused()) return std::make_unique<DivingState>();
    return {};
}

void PausedState::drawOverlay(const StateContext&, const Pen& pen) const {
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

ResultsState::ResultsState(StateContext& context)
    : newBest_(context.session.after.score > context.bestScore) {
    if (!newBest_) return;
    context.bestScore = context.session.after.score;
    // Only what a person has played counts.
    if (context.keepsScores && context.byPerson())
        if (Status saved = saveBestScore(context.diveName, context.bestScore); !saved)
            log::warn("{}", saved.error().message());
}

ProgramState::Next ResultsState::keyPressed(StateContext& context, int key) {
    context.leaving |= key == GLFW_KEY_ESCAPE || key == GLFW_KEY_Q;
    if (key == GLFW_KEY_P) context.session.paused = false;
    if (key == GLFW_KEY_R || key == GLFW_KEY_ENTER) context.restart();
    return {};
}

ProgramState::Next ResultsState::clicked(StateContext& context) {
    context.restart();
    return {};
}

// Once the simulation has begun again.
ProgramState::Next ResultsState::update(StateContext& context) {
    if (context.showsResults()) return {};
    return std::make_unique<DivingState>();
}

void ResultsState::drawOverlay(const StateContext& context, const Pen& pen) const {
    const game::Snapshot& s = context.session.shown;
    pen.panel(22, 13);
    const float x = pen.size.x / 2;
    float y = pen.size.y / 2 - pen.line * 5.6f;
    pen.text(x, y, 0.5f, 1.4f, colour::kWhite, "The dive is over");
    pen.text(x, y += pen.line * 2.0f, 0.5f, 2.6f, colour::kGold, std::to_string(s.score));
    pen.text(x, y += pen.line * 3.2f, 0.5f, 0.9f, colour::kWhite,
             fmt::format("{} fish caught, {} taken by the shark", s.caught, s.lost));
    pen.text(x, y += pen.line * 1.4f, 0.5f, 0.9f, newBest_ ? colour::kOrange : colour::kDim,
             newBest_ ? "Your best dive yet" : fmt::format("Your best: {}", context.bestScore));
    pen.text(x, y + pen.line * 2.4f, 0.5f, 0.85f, colour::kWhite,
             pen.audience == Audience::HeadsetPlayer ? "Close both hands: dive again"
                                                     : "Enter or a click: dive again      Esc: leave");
}

} // namespace shoal::app
