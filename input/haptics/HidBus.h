// Access to haptic devices: through hidapi, or a recording fake in tests.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace shoal::haptics {

// ForceFeedback: not HID, but the kernel's own driver (ForceFeedback.h).
enum class Transport { Any, Usb, Bluetooth, ForceFeedback };

struct HidInfo {
    std::string path; // for HidBus::open()
    uint16_t vendor = 0, product = 0;
    Transport transport = Transport::Any;
    std::string name;   // as the device calls itself; may be empty
    std::string device; // the system's name of the physical device, which may have several paths; or empty
    uint16_t usagePage = 0, usage = 0; // of its first collection of reports
};

// An open device; its destructor closes it.
class HidDevice {
  public:
    virtual ~HidDevice() = default;
    virtual bool write(std::span<const uint8_t> report) = 0; // false: the device is gone
    // Reads the feature report whose id is the buffer's first byte. Returns the number of bytes, with the id;
    // 0 on failure.
    virtual size_t readFeature(std::span<uint8_t>) { return 0; }
    // Arranges that this report is written if the program dies while the device is open.
    virtual void stopAtCrash(std::span<const uint8_t>) {}
};

struct HidBus {
    // Lists all devices, each path once; takes some milliseconds if something was plugged in or out.
    std::function<std::vector<HidInfo>()> list;
    std::function<std::unique_ptr<HidDevice>(const std::string& path)> open; // null: it may not be opened
};

// Makes hidapi's bus. One thread at a time; lives until the last copy goes.
HidBus hidapiBus();

} // namespace shoal::haptics
