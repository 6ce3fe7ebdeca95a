// A dive that a modelled person plays. The input takes the path of a real one: pointer, help with reach and
// the mouse's hand, or tracker, filters and selection of hands; 60 frames and 120 ticks a second.
#pragma once

#include "game/rules/Dive.h"
#include "input/hands/HandRig.h"
#include "tests/bench/player/Player.h"

#include <array>
#include <functional>

namespace shoal::player {

constexpr double kHeeds_s = 0.6;

struct PlayerSetup {
    Skill skill = Skill::Novice;
    Device device = Device::Mouse;
    game::DiveRules rules;
    float reachHelp = 1;
    float arm_m = 1.2f; // with hands: leaning forward, before a screen; 0.7 m: seated in a headset
    bool cracksMussels = false;
    // Share of the shark's warnings after which the hand is open from kHeeds_s on, until it aims no more.
    float heedsShark = 0;
    uint64_t seed = 1; // of the dive; the person's own follows from it
};

struct PlayedDive {
    int caught = 0, lost = 0, points = 0;
    float firstCatch_s = 1e9f; // of the dive's clock
    int closings = 0, escapes = 0, startles = 0;
    std::array<int, 6> misses{};          // by game::Miss
    std::array<float, kDoings> spent_s{}; // by Doing
};

// watch, if given, is called with the dive after every tick.
using Watch = std::function<void(const game::DiveState&, const game::Events&)>;
PlayedDive play(const game::DiveFiles&, const hands::HandRig&, const PlayerSetup&, const Watch& watch = {});

} // namespace shoal::player
