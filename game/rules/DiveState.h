// The state of a dive, and the form in which the rules of a tick read it.
#pragma once

#include "engine/core/Random.h"
#include "engine/physics/ContactWorld.h"
#include "game/rules/Creatures.h"
#include "game/rules/DiveFile.h"
#include "game/rules/DiveRules.h"
#include "game/rules/FilmSpace.h"
#include "game/rules/Hand.h"
#include "game/rules/Score.h"

#include <vector>

namespace shoal::game {

// The complete state of a dive: with the files and the coming inputs it determines the future. Plain data.
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
    Passer passer;                          // its creature id comes after the shark's
    std::vector<physics::Contact> contacts; // of this tick; the next tick continues those that last

    float time_s() const { return static_cast<float>(tick) * kDt; } // since the dive began
};

// The dive as its rules read it. A rule takes the parts that it changes as arguments of its own.
struct DiveContext {
    const DiveFile& dive;
    const SpeciesTable& species;
    const DiveState& state;
    FilmMoment film{};
    Assist assist = Assist::None;

    const Species& kindOf(const Fish& fish) const { return species[fish.species]; }
    const Species& kindOf(const Shark& shark) const { return species[shark.species]; }
    glm::vec3 head() const { return state.view.headWorld; }
    bool hides(glm::vec3 place) const { return film.hides(head(), place); }
    // Returns whether a hand can take hold of the fish now.
    bool mayBeTaken(const Fish& f) const { return f.free() && f.uncatchable_s <= 0 && !kindOf(f).stings; }
};

} // namespace shoal::game
