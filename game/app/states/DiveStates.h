// The states of a dive: it goes on, stands still, or is over.
#pragma once

#include "game/app/states/ProgramState.h"

namespace shoal::app {

class DivingState : public ProgramState {
  public:
    Next keyPressed(StateContext& context, int key) override;
    Next focusLost(StateContext& context) override;
    Next update(StateContext& context) override;
    void drawOverlay(const StateContext& context, const Pen& pen) const override; // first hints
};

// Until the player goes on, starts again or leaves.
class PausedState : public ProgramState {
  public:
    Next keyPressed(StateContext& context, int key) override;
    Next update(StateContext& context) override;
    void drawOverlay(const StateContext& context, const Pen& pen) const override;
};

// The score of the dive, and the best so far.
class ResultsState : public ProgramState {
  public:
    // Keeps the score if it is the best.
    explicit ResultsState(StateContext& context);

    Next keyPressed(StateContext& context, int key) override;
    Next clicked(StateContext& context) override;
    Next update(StateContext& context) override;
    void drawOverlay(const StateContext& context, const Pen& pen) const override;

  private:
    bool newBest_; // this dive's score is better than all before
};

} // namespace shoal::app
