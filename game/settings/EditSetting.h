// Changing a setting in the game: what it shows, and what a step or a slider does to it.
#pragma once

#include "game/settings/Setting.h"

namespace shoal::app {

// In the language of the screen; numbers as percent where that says more.
std::string shownValue(const Setting& setting, game::Language language);

// Of a number in its range, 0 to 1; empty: it is a choice.
std::optional<float> sliderOf(const Setting& setting);

// To the next value, or steps beyond; choices begin again at their end.
void adjust(const Setting& setting, int steps);
void slide(const Setting& setting, float fraction);

} // namespace shoal::app
