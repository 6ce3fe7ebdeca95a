#include "engine/xr/OpenXr.h"

#include "engine/xr/Tracked.h"

namespace shoal::xr {

HandTrackers HandTrackers::make(const Instance& instance, XrSession session) {
    HandTrackers made;
    if (!instance.bareHands) return made;
    const XrInstance name = instance.handle.name();
    const auto create = functionOf<PFN_xrCreateHandTrackerEXT>(name, "xrCreateHandTrackerEXT");
    const auto destroy = functionOf<PFN_xrDestroyHandTrackerEXT>(name, "xrDestroyHandTrackerEXT");
    made.locate_ = functionOf<PFN_xrLocateHandJointsEXT>(name, "xrLocateHandJointsEXT");
    if (!create || !destroy || !made.locate_)
        throw Failure("the runtime promises XR_EXT_hand_tracking and lacks its functions");
    for (size_t i = 0; i < 2; ++i) {
        const XrHandTrackerCreateInfoEXT info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT, nullptr,
                                              i == 0 ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT,
                                              XR_HAND_JOINT_SET_DEFAULT_EXT};
        XrHandTrackerEXT tracker = XR_NULL_HANDLE;
        check(create(session, &info, &tracker), "xrCreateHandTrackerEXT");
        made.trackers_.emplace_back(tracker, destroy);
    }
    return made;
}

static_assert(XR_HAND_JOINT_COUNT_EXT == hands::kJointCount);

void HandTrackers::locate(XrSpace world, XrTime time, std::array<hands::HandPose, 2>& out) const {
    for (size_t i = 0; i < trackers_.size(); ++i) {
        hands::HandPose& hand = out[i];
        hand = {};
        std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
        const XrHandJointsLocateInfoEXT info{XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT, nullptr, world, time};
        XrHandJointLocationsEXT locations{XR_TYPE_HAND_JOINT_LOCATIONS_EXT, nullptr, XR_FALSE,
                                          static_cast<uint32_t>(joints.size()), joints.data()};
        check(locate_(trackers_[i].get(), &info, &locations), "xrLocateHandJointsEXT");
        hand.tracked = locations.isActive == XR_TRUE;
        int seen = 0;
        for (size_t j = 0; hand.tracked && j < joints.size(); ++j) {
            const XrHandJointLocationEXT& joint = joints[j];
            const Pose worldFromJoint = poseFrom(joint.pose);
            hand.tracked = valid(joint.locationFlags) && believable(worldFromJoint);
            seen += both(joint.locationFlags, XR_SPACE_LOCATION_POSITION_TRACKED_BIT,
                         XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT);
            hand.joints[j].position = worldFromJoint.position;
            hand.joints[j].orientation = worldFromJoint.orientation;
            if (joint.radius >= 0.001f && joint.radius <= 0.1f) hand.joints[j].radius = joint.radius;
        }
        hand.confidence = static_cast<float>(seen) / hands::kJointCount;
    }
}

} // namespace shoal::xr
