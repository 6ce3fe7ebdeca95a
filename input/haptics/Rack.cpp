#include "input/haptics/Rack.h"

#include <algorithm>

namespace shoal::haptics {

void Rack::look() {
    for (const HidInfo& info : bus_.list()) {
        const Controller* controller = findController(info.vendor, info.product);
        const bool known = std::any_of(devices_.begin(), devices_.end(),
                                       [&](const Device& d) { return d.path == info.path; });
        if (!controller || known) continue;
        auto handle = bus_.open(info.path);
        if (handle) {
            devices_.push_back({info.path, controller, *handle});
            refused_.erase(info.path);
        } else if (!std::exchange(refused_[info.path], true)) {
            complaints_.push_back(std::string(controller->name) + ": " + handle.error().sentence());
        }
    }
}

void Rack::step(const HapticFrame& frame, double now_s) {
    if (now_s - looked_s_ >= kLook_s) {
        looked_s_ = now_s;
        look();
    }
    const Motors motors = motorsOf(frame);
    std::erase_if(devices_, [&](Device& device) {
        const bool changed = device.sentAny ? motors != device.sent : motors != Motors{};
        const bool stale = device.sentAny && device.sent != Motors{} && now_s - device.sent_s >= kRefresh_s;
        if (!(changed && now_s - device.sent_s >= kLeastWrite_s) && !stale) return false;
        const Report report = device.controller->encode(motors);
        if (!bus_.write(device.handle, std::span(report.bytes).first(report.size))) {
            bus_.close(device.handle);
            return true;
        }
        device.sent = motors;
        device.sent_s = now_s;
        device.sentAny = true;
        return false;
    });
}

void Rack::silence() {
    for (Device& device : devices_) {
        if (device.sent != Motors{}) {
            const Report report = device.controller->encode({});
            bus_.write(device.handle, std::span(report.bytes).first(report.size));
        }
        bus_.close(device.handle);
    }
    devices_.clear();
}

} // namespace shoal::haptics
