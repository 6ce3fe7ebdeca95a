// The dive is over: its score, and the best so far.
#pragma once

#include "game/app/states/ProgramState.h"

namespace shoal::app {

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
