// Conversion of a headset's tracked hands, or of its controllers, to hand poses in the viewer's frame.
#pragma once

#include "engine/xr/Tracked.h"
#include "input/hands/HandRig.h"

namespace shoal::hands {

// A bare hand as xr::Tracking has it.
HandPose handFromJoints(const HandPose& inWorld, const xr::Pose& worldFromHead);

// A hand around a controller: the palm at the grip pose, the last three fingers as far bent as it is
// squeezed, thumb and index finger by the trigger.
HandPose handFromController(const HandRig&, Side, const xr::Controller&, const xr::Pose& worldFromHead);

// Left and right: bare where that hand is seen, else from its controller, else not tracked.
std::array<HandPose, 2> openXrHands(const HandRig&, const xr::Tracking&);

} // namespace shoal::hands
