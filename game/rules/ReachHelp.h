// Help with depth for a hand that a pointer moves: finds the fish under the pointer and its distance.
#pragma once

#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <optional>

namespace shoal::game {

// Each pointer has its own; it is no part of the simulation's state. The target stays until the pointer is
// clearly nearer to another fish.
class ReachHelp {
  public:
    // Returns the distance from the eye, metres, that a hand on the ray should have: that of the fish near
    // it, predicted a short time ahead; empty if no catchable fish is near the ray. rayView: unit, viewer's
    // frame; hand_m: the hand's distance now. Called once a frame.
    std::optional<float> update(const Snapshot&, const SpeciesTable&, glm::vec3 rayView, float hand_m);

  private:
    int target_ = -1;
};

} // namespace shoal::game
