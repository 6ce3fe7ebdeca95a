// Velocity of a free body after contacts with hands; see ContactModel.h, step 3. World frame, m/s.
#pragma once

#include "engine/physics/ContactWorld.h"

#include <span>

namespace shoal::physics {

// All contacts are those of one body.

// Its velocity after the contacts: no slower along a normal than the mover there, as far as they agree.
// Against movers that rest it never gains speed.
glm::vec3 pushed(glm::vec3 velocity, std::span<const Contact>);

// The velocity that parts what overlaps; to be moved by for one tick, not to be kept. At most kPartMax_mps
// where contacts agree, and next to nothing where they contradict one another.
glm::vec3 parting(std::span<const Contact>);

} // namespace shoal::physics
