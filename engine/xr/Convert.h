// OpenXR's vectors are ours under other names. Only for the sources of this folder.
#pragma once

#include "engine/xr/Tracked.h"

#include <openxr/openxr.h>

namespace shoal::xr {

inline Pose poseFrom(const XrPosef& pose) {
    const auto& [p, q] = std::pair(pose.position, pose.orientation);
    return {{p.x, p.y, p.z}, glm::quat(q.w, q.x, q.y, q.z)};
}

inline XrPosef poseTo(const Pose& pose) {
    const glm::quat& q = pose.orientation;
    return {{q.x, q.y, q.z, q.w}, {pose.position.x, pose.position.y, pose.position.z}};
}

inline bool both(XrSpaceLocationFlags flags, XrSpaceLocationFlags a, XrSpaceLocationFlags b) {
    return (flags & a) && (flags & b);
}
inline bool valid(XrSpaceLocationFlags flags) {
    return both(flags, XR_SPACE_LOCATION_POSITION_VALID_BIT, XR_SPACE_LOCATION_ORIENTATION_VALID_BIT);
}

} // namespace shoal::xr
