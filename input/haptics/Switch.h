// Amplitude and frequency codes of Nintendo's controllers: a voice coil in each hand that plays two tones at
// a time. Pure.
#pragma once

#include "input/haptics/HapticFrame.h"

#include <cstdint>

namespace shoal::haptics {

// The two tones of one side in four bytes, by the tables of dekuNukem's Nintendo_Switch_Reverse_Engineering
// (rumble_data_table.md): the high one 82 to 1253 Hz, the low one 41 to 626 Hz, amplitudes up to the last
// that is safe for the coil. Frequencies out of range go to its end; of a silent tone the frequency is the
// neutral one, 320 and 160 Hz.
std::array<uint8_t, 4> encodeSwitchTones(const Actuation& high, const Actuation& low);

// A table's number of an amplitude, 0 to 100.
int switchAmplitudeIndex(float amplitude);

} // namespace shoal::haptics
