// The fingertip glove of GLOVE.md, seen from the game.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/Report.h"
#include "input/haptics/ReportDescriptor.h"

namespace shoal::haptics {

bool isGlove(const ReportLayout& layout);

// The body, for which a glove has nothing, goes to both palms.
Report encodeGlove(const HapticFrame& frame);
void sealGlove(Report& report, uint8_t sequence);

} // namespace shoal::haptics
