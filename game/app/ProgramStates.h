// The states of the program, and the menu pages that each shows over the picture. Main thread.
#pragma once

#include "game/app/FirstSteps.h"
#include "game/app/Screens.h"
#include "game/session/GameSession.h"

namespace shoal::app {

class ProgramStates {
  public:
    enum class State { Title, Diving, Paused, Results };

    // Session and screens must outlive this. keepsScores: writes scores to the player's file.
    ProgramStates(GameSession& session, Screens& screens, Mode mode, bool keepsScores);

    State state() const;
    Mode mode() const { return mode_; }
    bool byPerson() const { return playedByAPerson(session_.source); }
    // Whether the title screen is shown, behind which nobody moves the hands.
    bool idle() const { return state() == State::Title; }

    // Handles input of the game; menus read their own.
    void input(const Controls& controls, bool lostFocus, bool& leaving);
    // Opens and closes pages, and keeps score and guide; once a frame, after the simulation.
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
