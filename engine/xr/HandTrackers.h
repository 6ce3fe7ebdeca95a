// Hands without controllers, tracked through XR_EXT_hand_tracking. Private to this folder.
#pragma once

#include "engine/xr/OpenXr.h"

#include <array>

namespace shoal::xr {

class HandTrackers {
  public:
    HandTrackers() = default;
    HandTrackers(HandTrackers&&) noexcept;
    HandTrackers& operator=(HandTrackers&&) noexcept;
    ~HandTrackers();

    // Without the extension: hands that are never active.
    static HandTrackers make(const Instance& instance, XrSession session);
    void locate(XrSpace world, XrTime time, std::array<TrackedHand, 2>& out) const;

  private:
    std::array<XrHandTrackerEXT, 2> trackers_{};
    PFN_xrLocateHandJointsEXT locate_ = nullptr;
    PFN_xrDestroyHandTrackerEXT destroy_ = nullptr;
};

} // namespace shoal::xr
