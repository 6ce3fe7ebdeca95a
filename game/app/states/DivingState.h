// The dive goes on.
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

} // namespace shoal::app
