// The player's choice of rules before a dive. A replay's header holds it: with the same rules, seed and
// inputs a dive goes the same way. The defaults are those of the settings.
#pragma once

#include "engine/core/EnumNames.h"

namespace shoal::game {

// Help for a hand that reaches for a fish (game/rules/Intent.h). None: it takes hold only of a fish that its
// fingers really close around.
enum class Assist { None, Normal, Strong };

struct DiveRules {
    Assist assist = Assist::Normal;
    bool freeSwim = false; // no clock, no shark, no goals
    // The player sits: no fish circles where only a step or bent knees would reach it.
    bool seated = false;

    bool operator==(const DiveRules&) const = default;
};

} // namespace shoal::game

template <> inline constexpr std::array shoal::kEnumNames<shoal::game::Assist> = {"none", "normal", "strong"};
