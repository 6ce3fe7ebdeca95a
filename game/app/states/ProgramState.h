// One state of the program while it runs: what the player's input does, when another state follows, and what
// is drawn over the picture. A new state is one class. Main thread.
#pragma once

#include "game/session/GameSession.h"
#include "game/ui/Pen.h"

#include <memory>
#include <string>

namespace shoal::app {

// What states see and change.
struct StateContext {
    GameSession& session;
    const std::string& diveName;
    int& bestScore;   // of this dive, as far as is known
    bool keepsScores; // in the player's file
    bool& leaving;

    bool byPerson() const { return playedByAPerson(session.source); }
    // As the player or the headset has decided, or the script or replay that plays.
    bool paused() const { return byPerson() ? session.paused : session.after.paused; }
    bool showsResults() const { return session.after.phase == game::Phase::Results; }
    void restart() {
        session.restart = true;
        session.paused = false;
    }
};

class ProgramState {
  public:
    using Next = std::unique_ptr<ProgramState>; // empty: this state stays

    virtual ~ProgramState() = default;
    virtual Next keyPressed(StateContext&, int key) = 0; // GLFW_KEY_*
    virtual Next clicked(StateContext&) { return {}; }
    virtual Next focusLost(StateContext&) { return {}; } // the window is no longer the player's
    virtual Next update(StateContext&) = 0;              // once a frame, after the simulation
    virtual void drawOverlay(const StateContext&, const Pen&) const = 0;
};

class StateMachine {
  public:
    explicit StateMachine(std::unique_ptr<ProgramState> first) : state_(std::move(first)) {}

    void input(StateContext& context, const platform::WindowInput& input, bool pausesWithoutFocus) {
        if (pausesWithoutFocus && !input.focused) follow(state_->focusLost(context));
        for (const int key : input.keysPressed) follow(state_->keyPressed(context, key));
        if (input.leftPressed) follow(state_->clicked(context));
        if (context.session.restart) context.session.paused = false;
    }
    void update(StateContext& context) { follow(state_->update(context)); }
    void drawOverlay(const StateContext& context, const Pen& pen) const { state_->drawOverlay(context, pen); }

  private:
    void follow(ProgramState::Next next) {
        if (next) state_ = std::move(next);
    }
    std::unique_ptr<ProgramState> state_;
};

} // namespace shoal::app
