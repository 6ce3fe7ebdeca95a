// A bus that notes what is done to it, and frames to send over it.
#pragma once

#include "input/haptics/DeviceTable.h"

#include <algorithm>
#include <cstdint>
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
    const ReadFeature none = [](std::span<uint8_t>) { return size_t{0}; };
    return row.driver({row.product, transport == Transport::Bluetooth, none});
}

// A vendor number that is given to nobody, for a device that no table knows.
constexpr uint16_t kNoVendor = 0xFFFF;

struct FakeBus {
    struct Node {
        HidInfo info;
        std::vector<uint8_t> feature; // with its id
        bool permitted = true;
    };
    std::vector<Node> plugged;
    std::map<std::string, std::vector<std::vector<uint8_t>>> written, guarded; // by path
    std::vector<std::string> open; // paths by handle, "" once closed
    int lists = 0;

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
    size_t opened() const {
        return static_cast<size_t>(
            std::count_if(open.begin(), open.end(), [](const auto& p) { return !p.empty(); }));
    }

    HidBus bus() {
        HidBus made;
        made.list = [this] {
            ++lists;
            std::vector<HidInfo> infos;
            for (const Node& node : plugged) infos.push_back(node.info);
            return infos;
        };
        made.open = [this](const std::string& path) -> Result<int> {
            if (!find(path)->permitted) return Error{path, "may not be opened"};
            open.push_back(path);
            return static_cast<int>(open.size()) - 1;
        };
        made.write = [this](int handle, std::span<const uint8_t> report) {
            const std::string& path = open[static_cast<size_t>(handle)];
            if (!find(path)) return false;
            written[path].emplace_back(report.begin(), report.end());
            return true;
        };
        made.readFeature = [this](int handle, std::span<uint8_t> report) -> size_t {
            const Node* node = find(open[static_cast<size_t>(handle)]);
            if (!node || node->feature.empty() || node->feature[0] != report[0]) return 0;
            const size_t size = std::min(report.size(), node->feature.size());
            std::copy_n(node->feature.begin(), size, report.begin());
            return size;
        };
        made.guard = [this](int handle, std::span<const uint8_t> stop) {
            guarded[open[static_cast<size_t>(handle)]].emplace_back(stop.begin(), stop.end());
        };
        made.close = [this](int handle) { open[static_cast<size_t>(handle)].clear(); };
        return made;
    }
};

} // namespace shoal::haptics
