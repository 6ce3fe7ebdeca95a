#include "input/haptics/HidBus.h"

#include "input/haptics/CrashStop.h"
#include "input/haptics/DeviceFolder.h"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace shoal::haptics {

namespace {

namespace fs = std::filesystem;

class HidapiDevice final : public HidDevice {
  public:
    HidapiDevice(const std::string& path, hid_device* device) : path_(path), device_(device, hid_close) {}
    bool write(std::span<const uint8_t> report) override {
        return hid_write(device_.get(), report.data(), report.size()) >= 0;
    }
    size_t readFeature(std::span<uint8_t> report) override {
        const int got = hid_get_feature_report(device_.get(), report.data(), report.size());
        return got > 0 ? static_cast<size_t>(got) : 0;
    }
    void stopAtCrash(std::span<const uint8_t> stop) override { crashStop_.emplace(path_, stop); }

  private:
    std::string path_;
    std::unique_ptr<hid_device, decltype(&hid_close)> device_;
    std::optional<CrashStop> crashStop_;
};

// Returns HidInfo::device of a path, for which hidapi 0.13 has no call.
std::string deviceOf(const std::string& path) {
    std::error_code none;
    return fs::canonical(fs::path("/sys/class/hidraw") / fs::path(path).filename() / "device", none).string();
}

struct Hidapi {
    std::vector<HidInfo> found;
    DeviceFolder folder{"/dev"};

    Hidapi() { hid_init(); }
    ~Hidapi() { hid_exit(); }

    void list() {
        found.clear();
        hid_device_info* first = hid_enumerate(0, 0);
        for (const hid_device_info* info = first; info; info = info->next) {
            if (!info->path || std::any_of(found.begin(), found.end(), [&](const HidInfo& other) {
                    return other.path == info->path; // one entry for each usage of a device
                }))
                continue;
            std::string name;
            for (const wchar_t* c = info->product_string; c && *c; ++c)
                name += *c > 31 && *c < 127 ? static_cast<char>(*c) : '?';
            found.push_back({info->path, info->vendor_id, info->product_id,
                             info->bus_type == HID_API_BUS_USB         ? Transport::Usb
                             : info->bus_type == HID_API_BUS_BLUETOOTH ? Transport::Bluetooth
                                                                       : Transport::Any,
                             std::move(name), deviceOf(info->path), info->usage_page, info->usage});
        }
        hid_free_enumeration(first);
    }
};

} // namespace

HidBus hidapiBus() {
    auto hidapi = std::make_shared<Hidapi>();
    HidBus bus;
    bus.list = [hidapi] {
        if (hidapi->folder.mayHaveChanged()) hidapi->list();
        return hidapi->found;
    };
    bus.open = [hidapi](const std::string& path) -> std::unique_ptr<HidDevice> {
        hid_device* device = hid_open_path(path.c_str());
        return device ? std::make_unique<HidapiDevice>(path, device) : nullptr;
    };
    return bus;
}

} // namespace shoal::haptics
