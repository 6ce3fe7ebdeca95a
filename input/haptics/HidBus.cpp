#include "input/haptics/HidBus.h"

#include "input/haptics/CrashStop.h"
#include "input/haptics/DeviceFolder.h"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace shoal::haptics {

namespace {

namespace fs = std::filesystem;

struct Opened {
    hid_device* device = nullptr;
    std::string path;
    int guard = -1;

    void close() {
        if (guard >= 0) crash::unguard(guard);
        if (device) hid_close(device);
        *this = {};
    }
};

// hidapi 0.13 has no call for this.
std::string deviceOf(const std::string& path) {
    std::error_code none;
    return fs::canonical(fs::path("/sys/class/hidraw") / fs::path(path).filename() / "device", none).string();
}

struct Hidapi {
    std::vector<Opened> devices; // by handle
    std::vector<HidInfo> found;
    DeviceFolder folder{"/dev"};

    Hidapi() {
        hid_init();
        crash::install();
    }
    ~Hidapi() {
        for (Opened& opened : devices) opened.close();
        hid_exit();
    }
    Opened& at(int handle) { return devices[static_cast<size_t>(handle)]; }

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
    bus.open = [hidapi](const std::string& path) -> Result<int> {
        hid_device* device = hid_open_path(path.c_str());
        if (!device) return Error{path, "may not be opened"};
        auto& devices = hidapi->devices;
        auto free = std::find_if(devices.begin(), devices.end(), [](const Opened& o) { return !o.device; });
        if (free == devices.end()) free = devices.emplace(devices.end());
        *free = {device, path};
        return static_cast<int>(free - devices.begin());
    };
    bus.write = [hidapi](int handle, std::span<const uint8_t> report) {
        const crash::Writing writing;
        return writing.allowed() && hid_write(hidapi->at(handle).device, report.data(), report.size()) >= 0;
    };
    bus.readFeature = [hidapi](int handle, std::span<uint8_t> report) {
        const int got = hid_get_feature_report(hidapi->at(handle).device, report.data(), report.size());
        return got > 0 ? static_cast<size_t>(got) : 0;
    };
    bus.guard = [hidapi](int handle, std::span<const uint8_t> stop) {
        Opened& opened = hidapi->at(handle);
        opened.guard = crash::guard(opened.path, stop);
    };
    bus.close = [hidapi](int handle) { hidapi->at(handle).close(); };
    return bus;
}

} // namespace shoal::haptics
