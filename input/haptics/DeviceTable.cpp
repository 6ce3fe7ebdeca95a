#include "input/haptics/DeviceTable.h"

#include <algorithm>

namespace shoal::haptics {

std::optional<Recognised>
recognise(const HidInfo& info, const std::function<std::vector<uint8_t>(const std::string&)>& descriptor) {
    if (info.transport == Transport::ForceFeedback)
        return Recognised{&kForceFeedback, {}, info.name.empty() ? kForceFeedback.name : info.name};
    for (const DeviceRow& row : kDevices)
        if (row.vendor == info.vendor && row.product == info.product &&
            (row.transport == Transport::Any || row.transport == info.transport))
            return Recognised{&row, {}, row.name};
    ReportLayout layout = readReportDescriptor(descriptor(info.path));
    for (const DescriptorRow& row : kDevicesByDescriptor)
        if (row.matches(layout)) {
            const bool named = row.device.driver == makeSimpleHaptic && !info.name.empty();
            return Recognised{&row.device, std::move(layout), named ? info.name : row.device.name};
        }
    return {};
}

std::optional<Driver> driverOf(const Recognised& device, Transport transport,
                               const ReadFeature& readFeature) {
    const DeviceRow& row = *device.row;
    auto driver = row.driver({row.product, transport == Transport::Bluetooth, device.layout, readFeature});
    if (!driver) return {};
    driver->minWrite_s = row.minWrite_s;
    driver->refresh_s = std::clamp(driver->refresh_s, row.minWrite_s, row.refresh_s);
    return driver;
}

} // namespace shoal::haptics
