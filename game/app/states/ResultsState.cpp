#include "game/app/states/ResultsState.h"

#include "engine/core/Log.h"
#include "game/app/states/DivingState.h"
#include "game/session/Scores.h"

#include <GLFW/glfw3.h>

#include <cstdio>

namespace shoal::app {

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
    char text[96];
    pen.text(x, y, 0.5f, 1.4f, colour::kWhite, "The dive is over");
    std::snprintf(text, sizeof text, "%d", s.score);
    pen.text(x, y += pen.line * 2.0f, 0.5f, 2.6f, colour::kGold, text);
    std::snprintf(text, sizeof text, "%d fish caught, %d taken by the shark", s.caught, s.lost);
    pen.text(x, y += pen.line * 3.2f, 0.5f, 0.9f, colour::kWhite, text);
    std::snprintf(text, sizeof text, "Your best: %d", context.bestScore);
    pen.text(x, y += pen.line * 1.4f, 0.5f, 0.9f, newBest_ ? colour::kOrange : colour::kDim,
             newBest_ ? "Your best dive yet" : text);
    pen.text(x, y + pen.line * 2.4f, 0.5f, 0.85f, colour::kWhite,
             pen.audience == Audience::HeadsetPlayer ? "Close both hands: dive again"
                                                     : "Enter or a click: dive again      Esc: leave");
}

} // namespace shoal::app
