// Depth of hands that a pointer moves: finds the fish under the pointer and its distance.
#pragma once

#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <optional>

namespace shoal::game {

// One for each pointer; no part of the simulation's state. The target stays until the pointer is clearly
// nearer to another fish.
class ReachHelp {
  public:
    // Returns how far from the eye a hand on the ray should be, metres, a little ahead of a fish that comes
    // or goes; empty: no catchable fish is around the ray. rayView: unit, viewer's frame; hand_m: the hand's
    // distance now. Called once a frame.
    std::optional<float> update(const Snapshot&, const SpeciesTable&, glm::vec3 rayView, float hand_m);

  private:
    int target_ = -1;
};

} // namespace shoal::game
