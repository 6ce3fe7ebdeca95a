#include "engine/xr/OpenXr.h"

#include "engine/xr/Tracked.h"

namespace shoal::xr {

HandTrackers::HandTrackers(HandTrackers&& other) noexcept { *this = std::move(other); }

HandTrackers& HandTrackers::operator=(HandTrackers&& other) noexcept {
    std::swap(trackers_, other.trackers_);
    std::swap(locate_, other.locate_);
    std::swap(destroy_, other.destroy_);
    return *this;
}

HandTrackers::~HandTrackers() {
    for (XrHandTrackerEXT tracker : trackers_)
        if (tracker != XR_NULL_HANDLE) destroy_(tracker);
}

HandTrackers HandTrackers::make(const Instance& instance, XrSession session) {
    HandTrackers made;
    if (!instance.bareHands) return made;
    const XrInstance name = instance.handle.name();
    const auto create = functionOf<PFN_xrCreateHandTrackerEXT>(name, "xrCreateHandTrackerEXT");
    made.destroy_ = functionOf<PFN_xrDestroyHandTrackerEXT>(name, "xrDestroyHandTrackerEXT");
    made.locate_ = functionOf<PFN_xrLocateHandJointsEXT>(name, "xrLocateHandJointsEXT");
    if (!create || !made.destroy_ || !made.locate_)
        throw Failure("the runtime promises XR_EXT_hand_tracking and lacks its functions");
    for (size_t i = 0; i < 2; ++i) {
        const XrHandTrackerCreateInfoEXT info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT, nullptr,
                                              i == 0 ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT,
                                              XR_HAND_JOINT_SET_DEFAULT_EXT};
        check(create(session, &info, &made.trackers_[i]), "xrCreateHandTrackerEXT");
    }
    return made;
}

static_assert(XR_HAND_JOINT_COUNT_EXT == hands::kJointCount);

void HandTrackers::locate(XrSpace world, XrTime time, std::array<TrackedHand, 2>& out) const {
    for (size_t i = 0; i < 2; ++i) {
        TrackedHand& hand = out[i];
        hand.active = false;
        if (trackers_[i] == XR_NULL_HANDLE) continue;
        std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
        const XrHandJointsLocateInfoEXT info{XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT, nullptr, world, time};
        XrHandJointLocationsEXT locations{XR_TYPE_HAND_JOINT_LOCATIONS_EXT, nullptr, XR_FALSE,
                                          static_cast<uint32_t>(joints.size()), joints.data()};
        check(locate_(trackers_[i], &info, &locations), "xrLocateHandJointsEXT");
        hand.active = locations.isActive == XR_TRUE;
        for (size_t j = 0; hand.active && j < joints.size(); ++j) {
            const XrHandJointLocationEXT& joint = joints[j];
            TrackedJoint& to = hand.joints[j];
            to.worldFromJoint = poseFrom(joint.pose);
            to.radius = joint.radius;
            to.valid = valid(joint.locationFlags) && believable(to.worldFromJoint);
            to.seen = both(joint.locationFlags, XR_SPACE_LOCATION_POSITION_TRACKED_BIT,
                           XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT);
        }
    }
}

} // namespace shoal::xr
