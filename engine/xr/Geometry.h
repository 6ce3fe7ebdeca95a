// Conversion of a headset's eyes to views of the renderer, and plausibility checks of what a runtime reports.
#pragma once

#include "engine/render/View.h"
#include "engine/xr/Tracked.h"

namespace shoal::xr {

// The eye as the renderer draws it. The frustum's edges lie at the tangents of the field of view.
render::View viewOf(const Eye& eye);

// Positions finite and within 100 m, orientation of unit length to a tenth: else not to be believed.
bool believable(const Pose& pose);
// All edges within 89 degrees, right of left, up above down.
bool believable(const Fov& fov);

// Where a dive that starts with this head has its origin: at the eyes, upright, ahead where they look. Same
// frame as the head.
Pose originAt(const Pose& head);

} // namespace shoal::xr
