// A bus of fake devices that keeps all reports, and frames to send over it.
#pragma once

#include "input/haptics/DeviceTable.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace shoal::haptics {

inline HapticFrame frameOf(float amplitude, float frequency_Hz, size_t actuator = 3) {
    HapticFrame frame;
    frame.actuators[actuator] = {amplitude, frequency_Hz};
    return frame;
}

inline Driver driverOf(const DeviceRow& row, Transport transport) {
    struct Deaf final : HidDevice {
        bool write(std::span<const uint8_t>) override { return false; }
    } deaf;
    return row.driver({.product = row.product, .transport = transport}, deaf);
}

// A vendor number that is assigned to nobody, for a device that is in no table.
constexpr uint16_t kNoVendor = 0xFFFF;

struct FakeBus {
    struct Node {
        HidInfo info;
        std::vector<uint8_t> feature; // feature report, its id first
        bool permitted = true;
    };
    std::vector<Node> plugged;
    std::map<std::string, std::vector<std::vector<uint8_t>>> written, guarded; // by path
    size_t opened = 0;
    std::function<void(std::span<const uint8_t>)> onWrite;

    FakeBus() = default;
    FakeBus(uint16_t vendor, uint16_t product, Transport transport = Transport::Usb) {
        plug("a", vendor, product, transport);
    }
    void plug(std::string path, uint16_t vendor, uint16_t product, Transport transport = Transport::Usb) {
        plugged.push_back({{std::move(path), vendor, product, transport, ""}, {}});
    }
    void unplug(const std::string& path) {
        std::erase_if(plugged, [&](const Node& node) { return node.info.path == path; });
    }
    const Node* find(const std::string& path) const {
        for (const Node& node : plugged)
            if (node.info.path == path) return &node;
        return nullptr;
    }
    class Device final : public HidDevice {
      public:
        Device(FakeBus& bus, std::string path) : bus_(bus), path_(std::move(path)) { ++bus_.opened; }
        ~Device() override { --bus_.opened; }
        bool write(std::span<const uint8_t> report) override {
            if (!bus_.find(path_)) return false;
            if (bus_.onWrite) bus_.onWrite(report);
            bus_.written[path_].emplace_back(report.begin(), report.end());
            return true;
        }
        size_t readFeature(std::span<uint8_t> report) override {
            const Node* node = bus_.find(path_);
            if (!node || node->feature.empty() || node->feature[0] != report[0]) return 0;
            const size_t size = std::min(report.size(), node->feature.size());
            std::copy_n(node->feature.begin(), size, report.begin());
            return size;
        }
        void stopAtCrash(std::span<const uint8_t> stop) override {
            bus_.guarded[path_].emplace_back(stop.begin(), stop.end());
        }

      private:
        FakeBus& bus_;
        std::string path_;
    };

    HidBus bus() {
        const auto list = [this] {
            std::vector<HidInfo> infos;
            for (const Node& node : plugged) infos.push_back(node.info);
            return infos;
        };
        const auto open = [this](const std::string& path) {
            return find(path)->permitted ? std::make_unique<Device>(*this, path) : nullptr;
        };
        return {list, open};
    }
};

} // namespace shoal::haptics
