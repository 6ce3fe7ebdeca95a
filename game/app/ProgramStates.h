// What the program is doing, and which pages of the menus stand over the picture then. Main thread.
#pragma once

#include "game/app/Screens.h"
#include "game/session/GameSession.h"

namespace shoal::app {

// What a session is for.
enum class Mode { Title, FirstSteps, Dive, FreeSwim };

class ProgramStates {
  public:
    enum class State { Title, Diving, Paused, Results };

    // All outlive this. keepsScores: in the player's file.
    ProgramStates(GameSession& session, Screens& screens, Mode mode, bool keepsScores);

    State state() const;
    Mode mode() const { return mode_; }
    bool byPerson() const { return playedByAPerson(session_.source); }
    // Nobody moves the hands: the player is in the menus.
    bool idle() const { return state() == State::Title; }

    // Of the state that is shown; menus get their own.
    void input(const Controls& controls, bool lostFocus, bool& leaving);
    // Once a frame, after the simulation: opens and closes pages, and keeps score and guide.
    void update();

  private:
    void entered(State state);
    void keepScore();
    void keepGuide();

    GameSession& session_;
    Screens& screens_;
    Mode mode_;
    bool keepsScores_;
    State before_;
};

} // namespace shoal::app
