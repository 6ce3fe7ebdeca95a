// The devices plugged in now, and what is written to each when. Told the time, so it can be tested without
// waiting.
#pragma once

#include "input/haptics/Devices.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace shoal::haptics {

constexpr double kLook_s = 1.0; // between looks for new devices

class Rack {
  public:
    explicit Rack(HidBus bus) : bus_(std::move(bus)) {}
    ~Rack() { silence(); }
    Rack(const Rack&) = delete;
    Rack& operator=(const Rack&) = delete;

    // now_s: any clock that rises. Looks for devices when due, and writes what has changed or must be told
    // again, to each device no more often than it can take; a frame that came too soon is written when its
    // time comes, unless a newer one replaced it. A device that cannot be written to is dropped, and looked
    // for again. Returns after how many seconds to call again though no new frame should come.
    double step(const HapticFrame& frame, double now_s);

    // Stops all motors at once and lets go of the devices.
    void silence();

    bool still() const; // no motor runs; a stroke ends by itself

    struct Listed {
        std::string name, path;
        const char* motors;
        std::string trouble; // empty: it is ready
    };
    std::vector<Listed> list() const; // as of the last look
    size_t ready() const { return devices_.size(); }

    // Of the devices that cannot be used, each once.
    std::vector<std::string> takeComplaints() { return std::exchange(complaints_, {}); }

  private:
    struct Device {
        Listed listed;
        Driver driver;
        int handle = -1;
        Report silent; // unsealed
        Report sent;   // unsealed
        uint8_t sequence = 0;
        double sent_s = -1e9;
        float level = 0; // strongest amplitude of what was struck, fallen with the frames since
    };
    void look(double now_s);
    std::string add(const HidInfo& info, const Recognised& recognised, double now_s);
    bool write(Device& device, const Report& unsealed, double now_s);
    bool wants(Device& device, const Report& report, float strongest, double now_s) const;

    HidBus bus_;
    std::vector<Device> devices_;
    std::vector<Listed> refused_;
    std::set<std::string> complained_; // paths
    std::vector<std::string> complaints_;
    double looked_s_ = -1e9;
};

} // namespace shoal::haptics
