// Editing of a setting in the menus: its shown value, and the effect of a step or a slider.
#pragma once

#include "game/settings/Setting.h"

namespace shoal::app {

// Returns the value in the language of the screen; numbers as percent where that says more.
std::string shownValue(const Setting& setting, game::Language language);

// Returns a number's place in its range, 0 to 1; empty: the setting is a choice.
std::optional<float> sliderOf(const Setting& setting);

// Moves to the next value, or by several steps; choices wrap around.
void adjust(const Setting& setting, int steps);
void slide(const Setting& setting, float fraction);

} // namespace shoal::app
