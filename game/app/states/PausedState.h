// The dive stands still until the player goes on, starts again or leaves.
#pragma once

#include "game/app/states/ProgramState.h"

namespace shoal::app {

class PausedState : public ProgramState {
  public:
    Next keyPressed(StateContext& context, int key) override;
    Next update(StateContext& context) override;
    void drawOverlay(const StateContext& context, const Pen& pen) const override;
};

} // namespace shoal::app
