// The haptic devices that are plugged in, and the schedule of reports to each. Takes the time as an argument,
// so that tests need not wait. One thread.
#pragma once

#include "input/haptics/DeviceTable.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace shoal::haptics {

constexpr double kFindDevices_s = 1.0; // between two searches for new devices

class HapticDevices {
  public:
    explicit HapticDevices(HidBus bus) : bus_(std::move(bus)) {}
    ~HapticDevices() { stop(); }
    HapticDevices(const HapticDevices&) = delete;
    HapticDevices& operator=(const HapticDevices&) = delete;

    // now_s: a monotonic clock. Looks for devices when due, and writes to each device what has changed or
    // must be repeated, no more often than its minWrite_s; a frame that came too soon is written when its
    // time comes, unless a newer one replaced it. A device that cannot be written to is dropped, and looked
    // for again. Returns after how many seconds to call again at the latest.
    double step(const HapticFrame& frame, double now_s);

    // Stops all motors at once and lets go of the devices.
    void stop();

    bool allStopped() const; // no motor runs; a pulse of a one-shot device ends by itself

    struct Listed {
        std::string name, path;
        const char* motors;
        std::string problem; // empty: it is ready
    };
    std::vector<Listed> list() const; // as of the last search
    size_t ready() const { return devices_.size(); }

    // Of the devices that cannot be used, each once.
    std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

  private:
    struct Device {
        Listed listed;
        Driver driver;
        int handle = -1;
        Report stopped; // unsealed
        Report sent;    // unsealed
        uint8_t sequence = 0;
        double sent_s = -1e9;
        float level = 0; // one-shot: amplitude of the last pulse, lowered to those of the frames since
    };
    void findDevices(double now_s);
    std::string add(const HidInfo& info, const Recognised& recognised, double now_s);
    bool write(Device& device, const Report& unsealed, double now_s);
    bool needsWrite(Device& device, const Report& report, float strongest, double now_s) const;

    HidBus bus_;
    std::vector<Device> devices_;
    std::vector<Listed> refused_;
    std::set<std::string> warned_; // paths
    std::vector<std::string> warnings_;
    double found_s_ = -1e9;
};

} // namespace shoal::haptics
