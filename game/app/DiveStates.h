// A dive goes on, stands still or is over: what the player's input does then, and what is drawn over the
// picture. Main thread.
#pragma once

#include "game/session/GameSession.h"
#include "game/ui/Pen.h"

#include <string>

namespace shoal::app {

class DiveStates {
  public:
    // All must outlive this. bestScore: of this dive, as far as is known. keepsScores: in the player's file.
    DiveStates(GameSession& session, const std::string& diveName, int& bestScore, bool keepsScores,
               bool& leaving)
        : session_(session), diveName_(diveName), bestScore_(bestScore), keepsScores_(keepsScores),
          leaving_(leaving) {}

    enum class State { Diving, Paused, Results };
    State state() const;
    bool byPerson() const { return playedByAPerson(session_.source); }

    void input(const platform::WindowInput& input, bool pausesWithoutFocus);
    void update(); // once a frame, after the simulation: keeps the score if it is the best
    void drawOverlay(const Pen& pen) const;

  private:
    void keyPressed(int key); // GLFW_KEY_*
    void drawHints(const Pen& pen) const;
    void drawResults(const Pen& pen) const;

    GameSession& session_;
    const std::string& diveName_;
    int& bestScore_;
    bool keepsScores_;
    bool& leaving_;
    bool over_ = false, newBest_ = false; // the last dive's score is known; is better than all before
};

} // namespace shoal::app
