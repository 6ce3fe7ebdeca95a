#include "input/haptics/HidBus.h"

#include <hidapi/hidapi.h>

#include <memory>

namespace shoal::haptics {

namespace {

struct Hidapi {
    std::vector<hid_device*> devices; // by handle; null once closed
    Hidapi() { hid_init(); }
    ~Hidapi() {
        for (hid_device* device : devices)
            if (device) hid_close(device);
        hid_exit();
    }
};

} // namespace

HidBus hidapiBus() {
    auto hidapi = std::make_shared<Hidapi>();
    HidBus bus;
    bus.list = [hidapi] {
        std::vector<HidInfo> found;
        hid_device_info* first = hid_enumerate(0, 0);
        for (const hid_device_info* info = first; info; info = info->next)
            if (info->path) found.push_back({info->path, info->vendor_id, info->product_id});
        hid_free_enumeration(first);
        return found;
    };
    bus.open = [hidapi](const std::string& path) -> Result<int> {
        hid_device* device = hid_open_path(path.c_str());
        if (!device)
            return Error{
                path,
                "may not be opened; copy content/udev/70-shoal-haptics.rules to /etc/udev/rules.d and plug "
                "the controller in again"};
        for (size_t i = 0; i < hidapi->devices.size(); ++i)
            if (!hidapi->devices[i]) {
                hidapi->devices[i] = device;
                return static_cast<int>(i);
            }
        hidapi->devices.push_back(device);
        return static_cast<int>(hidapi->devices.size() - 1);
    };
    bus.write = [hidapi](int handle, std::span<const uint8_t> report) {
        return hid_write(hidapi->devices[static_cast<size_t>(handle)], report.data(), report.size()) >= 0;
    };
    bus.close = [hidapi](int handle) {
        hid_device*& device = hidapi->devices[static_cast<size_t>(handle)];
        hid_close(device);
        device = nullptr;
    };
    return bus;
}

} // namespace shoal::haptics
