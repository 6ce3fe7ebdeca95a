#include "input/haptics/DeviceTable.h"

#include "input/haptics/GloveReport.h"

namespace shoal::haptics {

const DeviceRow* recognise(const HidInfo& info) {
    if (info.transport == Transport::ForceFeedback) return &kForceFeedback;
    if (info.usagePage == glove::kUsagePage && info.usage == glove::kUsage) return &kGlove;
    for (const DeviceRow& row : kDevices)
        if (row.vendor == info.vendor && row.product == info.product &&
            (row.transport == Transport::Any || row.transport == info.transport))
            return &row;
    return nullptr;
}

} // namespace shoal::haptics
