// The controllers plugged in now, and what is written to each when. Told the time, so it can be tested
// without waiting.
#pragma once

#include "input/haptics/Controllers.h"
#include "input/haptics/HidBus.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace shoal::haptics {

constexpr double kLook_s = 1.0;         // between looks for new devices
constexpr double kLeastWrite_s = 0.008; // between two writes to a device
constexpr double kRefresh_s =
    0.5; // a motor that runs is told so again: controllers stop by themselves after a while

class Rack {
  public:
    explicit Rack(HidBus bus) : bus_(std::move(bus)) {}
    ~Rack() { silence(); }
    Rack(const Rack&) = delete;
    Rack& operator=(const Rack&) = delete;

    // now_s: any clock that rises. Looks for devices when due, writes what has changed or must be refreshed.
    // A device that cannot be written to is dropped, and looked for again.
    void step(const HapticFrame& frame, double now_s);

    // Stops all motors.
    void silence();

    size_t ready() const { return devices_.size(); }
    // Of the devices that may not be opened, each once.
    std::vector<std::string> takeComplaints() { return std::exchange(complaints_, {}); }

  private:
    struct Device {
        std::string path;
        const Controller* controller;
        int handle;
        Motors sent{};
        bool sentAny = false;
        double sent_s = -1e9;
    };
    void look();

    HidBus bus_;
    std::vector<Device> devices_;
    std::map<std::string, bool> refused_; // paths already complained about
    std::vector<std::string> complaints_;
    double looked_s_ = -1e9;
};

} // namespace shoal::haptics
