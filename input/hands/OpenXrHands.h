// Conversion of a headset's tracked hands, or of its controllers, to hand poses in the viewer's frame.
#pragma once

#include "engine/xr/Tracked.h"
#include "input/hands/HandRig.h"

namespace shoal::hands {

// Converts a bare hand of xr::Tracking, and estimates its grip and pinch.
HandPose handFromJoints(const HandPose& inWorld, const xr::Pose& worldFromHead);

// Returns a hand around a controller: the palm at the grip pose, the last three fingers bent by the squeeze,
// thumb and index finger by the trigger.
HandPose handFromController(const HandRig&, Side, const xr::Controller&, const xr::Pose& worldFromHead);

// Returns left and right hand: bare if that hand is seen, else from its controller, else not tracked.
std::array<HandPose, 2> openXrHands(const HandRig&, const xr::Tracking&);

} // namespace shoal::hands
