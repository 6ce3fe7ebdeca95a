// Reads the player's head and hands from the tick's input: believes only plausible poses, bridges short
// losses of tracking, and estimates smoothed velocities.
#pragma once

#include "game/rules/Hand.h"
#include "game/rules/TickInput.h"

namespace shoal::game {

// The player's head.
struct Viewpoint {
    glm::quat worldFromView{1, 0, 0, 0};
    glm::vec3 headWorld{0}; // between the eyes

    auto fields() const { return std::tie(worldFromView, headWorld); }
};

// Updates view and hands by this tick's input. Values that are not finite or absurd are ignored: the last
// good ones stay.
void trackHands(const TickInput&, Viewpoint&, Hands&);

} // namespace shoal::game
