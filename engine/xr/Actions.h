// What controllers do and feel: OpenXR's actions, bound for the common controllers. Only for the sources of
// this folder.
#pragma once

#include "engine/xr/Instance.h"
#include "engine/xr/Tracked.h"

#include <array>

namespace shoal::xr {

class Actions {
  public:
    Actions() = default;
    static Result<Actions> make(XrInstance instance, XrSession session);

    Status locate(XrSession session, XrSpace world, XrTime time, std::array<Controller, 2>& out) const;
    // amplitude 0 to 1; 0 stops. Runs until the next call, but no longer than kVibration_ns.
    Status vibrate(XrSession session, int hand, float amplitude, float frequency_Hz) const;

    // Longer than a frame, so that it does not stutter; short, so that it ends by itself if the game does.
    static constexpr XrDuration kVibration_ns = 100'000'000;

  private:
    Handle<XrActionSet, xrDestroyActionSet> set_;
    XrAction grip_{}, squeeze_{}, trigger_{}, menu_{}, haptic_{}; // owned by the set
    std::array<XrPath, 2> hands_{};
    std::array<Handle<XrSpace, xrDestroySpace>, 2> gripSpaces_;
};

} // namespace shoal::xr
