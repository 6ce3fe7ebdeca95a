// Many actuators on few motors.
#pragma once

#include "input/haptics/HapticFrame.h"

#include <cstdint>
#include <span>

namespace shoal::haptics {

// The two motors of a common controller, 0 to 1: a heavy slow one and a light quick one.
struct Motors {
    float strong = 0, weak = 0;
};

// Each actuation goes to both by its frequency, all to the strong one up to 60 Hz and all to the weak one
// from 200 Hz, and the strongest of them counts, so that many fingers are not felt as one blow. NaN is 0.
Motors motorsOf(std::span<const Actuation> actuations);
Motors motorsOf(const HapticFrame& frame); // of everything, the body too

// A hand's six actuators.
std::span<const Actuation> handOf(const HapticFrame& frame, int hand);

// The strongest with a frequency of at least / below that; amplitude 0 if there is none.
Actuation strongestFrom(std::span<const Actuation> actuations, float least_Hz);
Actuation strongestBelow(std::span<const Actuation> actuations, float limit_Hz);

// What a motor with an eccentric weight is driven by, 0 to 1. Such motors start only at about a fifth of
// their range; amplitudes are laid over what can be felt, and 0 stays 0.
float driveOf(float amplitude);

} // namespace shoal::haptics
