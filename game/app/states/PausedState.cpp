#include "game/app/states/PausedState.h"

#include "game/app/states/DivingState.h"
#include "game/app/states/ResultsState.h"

#include <GLFW/glfw3.h>

#include <array>

namespace shoal::app {

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

} // namespace shoal::app
