// What the common controllers with two or four motors want to read. Pure: a frame in, bytes out. What differs
// from one report to the next (a sequence number, and the checksum over it) is put in by sealing.
#pragma once

#include "input/haptics/HapticFrame.h"
#include "input/haptics/Report.h"

namespace shoal::haptics {

// Sony. Firmware of the DualSense from 2.21 on takes its vibration from another enabling bit.
Report encodeDualSenseUsb(const HapticFrame& frame);
Report encodeDualSenseUsbNew(const HapticFrame& frame);
Report encodeDualSenseBluetooth(const HapticFrame& frame);
Report encodeDualSenseBluetoothNew(const HapticFrame& frame);
void sealDualSenseBluetooth(Report& report, uint8_t sequence);

Report encodeDualShock4Usb(const HapticFrame& frame);
Report encodeDualShock4Bluetooth(const HapticFrame& frame);
void sealDualShock4Bluetooth(Report& report, uint8_t sequence);

// Microsoft over Bluetooth: two motors, and one behind each trigger, which are for the hands' fingers.
Report encodeXboxBluetooth(const HapticFrame& frame);

// Google.
Report encodeStadia(const HapticFrame& frame);

} // namespace shoal::haptics
