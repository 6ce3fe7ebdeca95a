// Rumble of gamepads through the kernel's own drivers: force feedback of /dev/input/event* (Linux, input/ff),
// which every user at the screen may open. It serves pads for which we have no driver, and those whose HID
// node may not be opened.
#pragma once

#include "input/haptics/HidBus.h"

namespace shoal::haptics {

// Returns the bus with such gamepads appended to its devices, with Transport::ForceFeedback. Their report is
// the strengths of the strong and of the weak motor, 16 bits each, the low byte first. The kernel stops them
// when the program dies.
HidBus withForceFeedback(HidBus bus);

} // namespace shoal::haptics
