#include "input/haptics/HapticDevices.h"

#include "engine/core/Log.h"
#include "input/haptics/GloveReport.h"
#include "input/haptics/HapticFrame.h"

#include <fmt/core.h>

namespace shoal::haptics {

constexpr double kStopping_s = 0.1; // time limit for the last reports, each at its device's pace

static std::string describe(const DeviceRow& row, const HidInfo& info) {
    const bool named = info.transport == Transport::ForceFeedback && !info.name.empty();
    const char* way = info.transport == Transport::Bluetooth ? " over Bluetooth"
                      : info.transport == Transport::Usb     ? " on USB"
                                                             : "";
    return (named ? info.name : row.name) + std::string(way);
}

// Returns what a person must do to get access, with the rule for this device.
static std::string notLetIn(const HidInfo& info) {
    if (info.transport == Transport::ForceFeedback) return "may not be opened";
    return fmt::format(
        "may not be opened; this rule in /etc/udev/rules.d/70-shoal-haptics.rules (content/udev "
        "has it for every device known) lets you in once it is plugged in again: "
        "KERNEL==\"hidraw*\", KERNELS==\"*:{:04X}:{:04X}.*\", TAG+=\"uaccess\"",
        info.vendor, info.product);
}

const DeviceRow* recognise(const HidInfo& info) {
    if (info.transport == Transport::ForceFeedback) return &kForceFeedback;
    if (info.usagePage == glove::kUsagePage && info.usage == glove::kUsage) return &kGlove;
    for (const DeviceRow& row : kDevices)
        if (row.vendor == info.vendor && row.product == info.product &&
            (row.transport == Transport::Any || row.transport == info.transport))
            return &row;
    return nullptr;
}

// Opens and adds a device. Returns the reason if it cannot be used, else an empty text.
std::string HapticDevices::add(const HidInfo& info, const DeviceRow& row, double now_s) {
    auto open = bus_.open(info.path);
    if (!open) return notLetIn(info);
    Device device{.listed = {describe(row, info), info.path, row.motors, ""},
                  .physical = info.device,
                  .row = &row,
                  .driver = row.driver(info, *open),
                  .open = std::move(open)};
    device.stopped = device.driver.encode({});
    device.open->stopAtCrash(device.driver.sealed(device.stopped, 0).view());
    for (const Report& initialReport : device.driver.initialReports)
        if (!write(device, initialReport, now_s)) return "does not answer";
    device.sent = device.stopped;
    devices_.push_back(std::move(device));
    return {};
}

void HapticDevices::findDevices(double now_s) {
    refused_.clear();
    for (const HidInfo& info : bus_.list()) {
        // A pad that is open through its HID node is not opened twice.
        const bool mayBeOpen = info.transport == Transport::ForceFeedback && !info.device.empty();
        if (std::ranges::any_of(devices_, [&](const Device& device) {
                return device.listed.path == info.path || (mayBeOpen && device.physical == info.device);
            }))
            continue;
        const DeviceRow* row = recognise(info);
        if (!row) continue;
        const std::string problem = add(info, *row, now_s);
        if (problem.empty()) {
            warned_.erase(info.path);
            continue;
        }
        refused_.push_back({describe(*row, info), info.path, row->motors, problem});
        if (warned_.insert(info.path).second)
            warnings_.push_back(describe(*row, info) + " at " + info.path + ": " + problem);
    }
}

bool HapticDevices::write(Device& device, const Report& unsealed, double now_s) {
    device.sent = unsealed;
    device.sent_s = now_s;
    return device.open->write(device.driver.sealed(unsealed, device.sequence++).view());
}

double HapticDevices::step(const HapticFrame& frame, double now_s) {
    if (now_s - found_s_ >= kFindDevices_s) {
        found_s_ = now_s;
        findDevices(now_s);
    }
    double next_s = found_s_ + kFindDevices_s;
    std::erase_if(devices_, [&](Device& device) {
        const Report report = device.driver.encode(frame);
        const double free_s = device.sent_s + device.row->minWrite_s;
        const bool refresh = report != device.stopped && now_s - device.sent_s >= device.row->refresh_s;
        if (report != device.sent || refresh) {
            if (now_s < free_s) {
                next_s = std::min(next_s, free_s);
                return false;
            }
            if (!write(device, report, now_s)) {
                // The device may still receive reports, so one more stops it.
                write(device, device.stopped, now_s);
                return true;
            }
        }
        if (device.sent != device.stopped) next_s = std::min(next_s, device.sent_s + device.row->refresh_s);
        return false;
    });
    return std::max(next_s - now_s, 0.0);
}

HapticDevices::~HapticDevices() {
    for (Device& device : devices_)
        if (device.sent != device.stopped) write(device, device.stopped, device.sent_s);
}

std::vector<HapticDevices::Listed> HapticDevices::list() const {
    std::vector<Listed> all;
    for (const Device& device : devices_) all.push_back(device.listed);
    all.insert(all.end(), refused_.begin(), refused_.end());
    return all;
}

void HapticOutput::submit(const HapticFrame& frame) {
    const std::lock_guard lock(mutex_);
    newest_ = {frame, Clock::now()};
    fresh_ = true;
    changed_.notify_one();
}

void HapticOutput::run(const std::stop_token& ending, const HidBus& bus) {
    HapticDevices hapticDevices(bus);
    const Clock::time_point began = Clock::now();
    for (double next_s = 0;;) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, ending, std::chrono::duration<double>(next_s), [&] { return fresh_; });
        if (ending.stop_requested()) break;
        fresh_ = false;
        const Submitted submitted = newest_;
        lock.unlock();
        const double left_s = kFelt_s - secondsSince(submitted.when);
        next_s = hapticDevices.step(left_s > 0 ? submitted.frame : HapticFrame(), secondsSince(began));
        for (const std::string& warning : hapticDevices.takeWarnings()) log::warn("{}", warning);
        if (left_s > 0) next_s = std::min(next_s, left_s);
    }
    const Clock::time_point stopping = Clock::now();
    double next_s = hapticDevices.step({}, secondsSince(began));
    while (!hapticDevices.allStopped() && secondsSince(stopping) < kStopping_s) {
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(next_s, kStopping_s)));
        next_s = hapticDevices.step({}, secondsSince(began)); // also where it slept for too long
    }
}

} // namespace shoal::haptics
