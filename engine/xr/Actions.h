// Input and vibration of controllers: OpenXR's actions, bound for the common controllers. Private to this
// folder.
#pragma once

#include "engine/xr/OpenXr.h"

#include <array>

namespace shoal::xr {

// A controller: what closes the hand, what bends the index finger, what pauses. Where there is but
// one button, it does both.
struct InteractionProfile {
    const char* name;
    const char* squeeze;
    const char* trigger;
    const char* menu;
    bool menuOnRight; // there is one on each hand
};

class Actions {
  public:
    Actions() = default;
    static Actions make(XrInstance instance, XrSession session);

    void locate(XrSession session, XrSpace world, XrTime time, std::array<Controller, 2>& out) const;
    // amplitude 0 to 1; 0 stops. Runs until the next call, but no longer than kVibration_ns.
    void vibrate(XrSession session, int hand, float amplitude, float frequency_Hz) const;

    // Longer than a frame, so that it does not stutter; short, so that it ends by itself if the game does.
    static constexpr XrDuration kVibration_ns = 100'000'000;

  private:
    void suggest(XrInstance instance, const InteractionProfile& profile) const;

    Handle<XrActionSet, xrDestroyActionSet> set_;
    XrAction grip_{}, squeeze_{}, trigger_{}, menu_{}, haptic_{}; // owned by the set
    std::array<XrPath, 2> hands_{};
    std::array<Handle<XrSpace, xrDestroySpace>, 2> gripSpaces_;
};

} // namespace shoal::xr
