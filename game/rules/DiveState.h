// The whole state of a dive: all that the future depends on besides its files and its inputs. Plain data.
#pragma once

#include "engine/core/Random.h"
#include "engine/physics/ContactWorld.h"
#include "game/rules/Catching.h"
#include "game/rules/Fish.h"
#include "game/rules/Hand.h"
#include "game/rules/Shark.h"

#include <tuple>
#include <vector>

namespace shoal::game {

struct DiveState {
    uint64_t seed = 0;
    Random random{};
    uint32_t tick = 0; // since the dive began
    uint64_t totalTicks = 0;
    Phase phase = Phase::Diving;
    bool begun = false, paused = false, restartHeld = false;
    Score score;
    Viewpoint view;
    Hands hands;
    std::vector<Fish> fish;
    Shark shark;                            // its creature id is fish.size()
    std::vector<physics::Contact> contacts; // of this tick; what lasts is next tick's past

    auto fields() const {
        return std::tie(seed, random, tick, totalTicks, phase, begun, paused, restartHeld, score, view, hands,
                        fish, shark, contacts);
    }
};

} // namespace shoal::game
