#include "game/app/states/DivingState.h"

#include "game/app/states/PausedState.h"
#include "game/app/states/ResultsState.h"

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

} // namespace shoal::app
