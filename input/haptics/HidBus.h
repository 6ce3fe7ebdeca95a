// Access to haptic devices: through hidapi, or a recording fake in tests.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace shoal::haptics {

// ForceFeedback: not HID, but the kernel's own driver.
enum class Transport { Any, Usb, Bluetooth, ForceFeedback };

struct HidInfo {
    std::string path; // for HidBus::open()
    uint16_t vendor = 0, product = 0;
    Transport transport = Transport::Any;
    std::string name;   // as the device calls itself; may be empty
    std::string device; // the system's name of the physical device, which may have several paths; or empty
    uint16_t usagePage = 0, usage = 0; // of its first HID collection
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
    // Lists all devices, each path once; takes some milliseconds.
    std::function<std::vector<HidInfo>()> list;
    std::function<std::unique_ptr<HidDevice>(const std::string& path)> open; // null: it may not be opened
};

// Makes a bus that uses hidapi; one thread at a time may use it.
HidBus hidapiBus();

// Returns the bus with gamepads appended that rumble through the kernel's own drivers: force feedback of
// /dev/input/event* (Linux, input/ff), which every user at the screen may open. It serves pads for which we
// have no driver, and those whose HID node may not be opened. Their report is the strengths of the strong and
// of the weak motor, 16 bits each, the low byte first. The kernel stops them when the program dies.
HidBus withForceFeedback(HidBus bus);

// A helper process that stops a device's motors when the program dies, however it dies.
class CrashStop {
  public:
    // Starts a shell that writes `stop` to the device's file if this process ends before the destructor runs.
    // The path must have no single quote. If no shell starts, nothing stops the motors.
    CrashStop(const std::string& file, std::span<const uint8_t> stop);
    ~CrashStop() {
        if (shell_) std::fputs("\n", shell_.get());
    }

  private:
    std::unique_ptr<FILE, int (*)(FILE*)> shell_{nullptr, pclose}; // its standard input; null: none
};

} // namespace shoal::haptics
