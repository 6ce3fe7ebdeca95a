// Help with depth for hands that a pointer moves: which fish the pointer is for, and how far away that is.
#pragma once

#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <optional>

namespace shoal::game {

// One of a player's; no part of the simulation's state. It keeps to a fish until the pointer is clearly
// nearer to another.
class ReachHelp {
  public:
    // Once a frame. rayView: unit, viewer's frame. Result: how far from the eye a hand on that ray should be,
    // metres, given how far it is; empty: there is no catchable fish around the ray. A little ahead of a fish
    // that comes or goes.
    std::optional<float> update(const Snapshot&, const SpeciesTable&, glm::vec3 rayView, float hand_m);

  private:
    int target_ = -1;
};

} // namespace shoal::game
