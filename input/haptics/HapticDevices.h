// The haptic devices that are plugged in, and the schedule of reports to each.
#pragma once

#include "input/haptics/DeviceTable.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace shoal::haptics {

constexpr double kFindDevices_s = 5; // time between two searches for new devices, which are costly

inline double secondsSince(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

class HapticDevices {
  public:
    explicit HapticDevices(HidBus bus) : bus_(std::move(bus)) {}
    ~HapticDevices(); // stops all motors at once
    HapticDevices(const HapticDevices&) = delete;
    HapticDevices& operator=(const HapticDevices&) = delete;

    // Looks for devices when due, and writes a changed or ongoing vibration to each, no more often than its
    // minWrite_s; a frame that came too soon is written when its time comes, unless a newer one replaced it.
    // A device that cannot be written to is dropped, and looked for again. Returns the longest time until the
    // next call, seconds. now_s: a monotonic clock, an argument so that tests need not wait.
    double step(const HapticFrame& frame, double now_s);

    bool allStopped() const { // no motor runs
        return std::ranges::all_of(devices_, [](const Device& each) { return each.sent == each.stopped; });
    }

    struct Listed {
        std::string name, path;
        const char* motors;
        std::string problem; // empty: it is ready
    };
    std::vector<Listed> list() const; // as of the last search
    size_t ready() const { return devices_.size(); }

    // Returns a message for each device that cannot be used, once.
    std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

  private:
    struct Device {
        Listed listed;
        std::string physical; // HidInfo::device
        const DeviceRow* row;
        Driver driver;
        std::unique_ptr<HidDevice> open;
        Report stopped; // unsealed
        Report sent;    // unsealed
        uint8_t sequence = 0;
        double sent_s = -1e9;
    };
    void findDevices(double now_s);
    std::string add(const HidInfo& info, const DeviceRow& row, double now_s);
    bool write(Device& device, const Report& unsealed, double now_s);

    HidBus bus_;
    std::vector<Device> devices_;
    std::vector<Listed> refused_;
    std::set<std::string> warned_; // paths
    std::vector<std::string> warnings_;
    double found_s_ = -1e9;
};

// Time for which a frame is felt unless a newer one comes; so the motors stop when the program stalls.
constexpr double kFelt_s = 0.25;

// Haptic output on a thread of its own, so that neither finding devices nor slow writes delay a picture. The
// destructor stops every motor, which takes the time of a few writes.
class HapticOutput {
  public:
    explicit HapticOutput(HidBus bus)
        : thread_([this, bus = std::move(bus)](const std::stop_token& ending) { run(ending, bus); }) {}

    // Sets the vibration from now on; only the newest frame counts. Does not allocate, and waits at most for
    // the copy of a frame.
    void submit(const HapticFrame& frame);

  private:
    using Clock = std::chrono::steady_clock;
    struct Submitted {
        HapticFrame frame;
        Clock::time_point when{};
    };
    void run(const std::stop_token& ending, const HidBus& bus);

    std::mutex mutex_; // guards newest_ and fresh_; held for a copy of one frame at a time
    std::condition_variable_any changed_;
    Submitted newest_;
    bool fresh_ = false;

    std::jthread thread_; // last: it uses all of the above
};

} // namespace shoal::haptics
