// Rumble of gamepads through the kernel's own drivers: force feedback of /dev/input/event* (Linux, input/ff),
// which every player at the screen may open. For all pads that no driver of ours knows, and for those whose
// HID node is not let in.
#pragma once

#include "input/haptics/HidBus.h"

namespace shoal::haptics {

// The bus with such gamepads behind its own devices, with Transport::ForceFeedback. Their report is the
// strengths of the strong and of the weak motor, 16 bits each, the low byte first; all 0 stops them. When the
// program dies, the kernel stops what it felt.
HidBus withForceFeedback(HidBus bus);

} // namespace shoal::haptics
