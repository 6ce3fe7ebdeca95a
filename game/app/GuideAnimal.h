// The animal of a page of the field guide: it turns beside it, in the light of the film. Main thread.
#pragma once

#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <glm/vec2.hpp>

namespace shoal::app {

class GuideAnimal {
  public:
    // Returns what the viewer of a snapshot sees instead: one animal, right of the middle. All animals look
    // equally large. species: index of `kind`; extent: of its model, the greatest along any axis over its
    // length; tanHalf: tangents of half the picture's angles; dt_s: time since the last call; turns: false:
    // it keeps its side to the viewer.
    const game::Snapshot& show(const game::Snapshot& viewer, int species, const game::Species& kind,
                               float extent, glm::vec2 tanHalf, float dt_s, bool turns);

  private:
    game::Snapshot shown_;
    float age_s_ = 0; // time for which this animal has been shown
};

} // namespace shoal::app
