// Actions of controllers, tracking of bare hands, and haptics.
#include "tests/gl/xr/runtime/State.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace shoal::test {

namespace {

int handOf(XrPath path) {
    if (path < 1 || path > pathTexts().size()) return -1;
    const std::string& text = pathTexts()[path - 1];
    return text == "/user/hand/left" ? 0 : text == "/user/hand/right" ? 1 : -1;
}

// Inputs below /input of the registry's interaction profiles (xr.xml, 1.1.53) for games, no poses or haptics;
// those of the left hand alone behind a bar. A profile without an extension is of OpenXR 1.0.
struct KnownProfile {
    const char *name, *inputs, *extension = nullptr;
};
constexpr char kTouch[] = "squeeze/value trigger/value | menu/click",
               kPico[] = "squeeze/value squeeze/click trigger/value trigger/click | menu/click";
constexpr KnownProfile kKnownProfiles[] = {
    {"khr/simple_controller", "select/click menu/click"},
    {"oculus/touch_controller", kTouch},
    {"valve/index_controller", "squeeze/value trigger/value trigger/click b/click"},
    {"htc/vive_controller", "squeeze/click trigger/value trigger/click menu/click"},
    {"microsoft/motion_controller", "squeeze/click trigger/value menu/click"},
    {"ext/hand_interaction_ext", "grasp_ext/value pinch_ext/value", "XR_EXT_hand_interaction"},
    {"facebook/touch_controller_pro", kTouch, "XR_FB_touch_controller_pro"},
    {"meta/touch_controller_plus", kTouch, "XR_META_touch_controller_plus"},
    {"bytedance/pico_neo3_controller", "squeeze/value squeeze/click trigger/value trigger/click menu/click",
     "XR_BD_controller_interaction"},
    {"bytedance/pico4_controller", kPico, "XR_BD_controller_interaction"},
    {"bytedance/pico_ultra_controller_bd", kPico, "XR_BD_ultra_controller_interaction"},
    {"htc/vive_focus3_controller", kPico, "XR_HTC_vive_focus3_controller_interaction"},
    {"hp/mixed_reality_controller", "squeeze/value trigger/value menu/click",
     "XR_EXT_hp_mixed_reality_controller"},
};
const KnownProfile* knownProfile(const std::string& path) {
    const auto* at = std::ranges::find_if(kKnownProfiles, [&](const KnownProfile& p) {
        return path == std::string("/interaction_profiles/") + p.name;
    });
    return at == std::end(kKnownProfiles) ? nullptr : at;
}
bool has(const KnownProfile& profile, const std::string& path) {
    const bool left = path.starts_with("/user/hand/left/");
    if (!left && !path.starts_with("/user/hand/right/")) return false;
    const std::string below = path.substr(std::strlen(left ? "/user/hand/left/" : "/user/hand/right/"));
    if (below == "input/grip/pose") return true;
    if (below == "output/haptic") return profile.name != std::string("ext/hand_interaction_ext");
    std::istringstream inputs(profile.inputs);
    for (std::string input; inputs >> input && (left || input != "|");)
        if (below == "input/" + input) return true;
    return false;
}

using ActionSet = std::deque<FakeAction>; // which stay where they are

FAKE_XR(xrCreateActionSet, XrInstance, const XrActionSetCreateInfo*, XrActionSet* out) {
    *out = handleOf<XrActionSet>(new ActionSet);
    return XR_SUCCESS;
}
FAKE_XR(xrDestroyActionSet, XrActionSet set) {
    delete &objectOf<ActionSet>(set);
    return XR_SUCCESS;
}
FAKE_XR(xrCreateAction, XrActionSet set, const XrActionCreateInfo* info, XrAction* out) {
    auto& actions = objectOf<ActionSet>(set);
    actions.push_back({info->actionType, info->actionName});
    *out = handleOf<XrAction>(&actions.back());
    return XR_SUCCESS;
}
FAKE_XR(xrDestroyAction, XrAction) { return XR_SUCCESS; }
FAKE_XR(xrSuggestInteractionProfileBindings, XrInstance,
        const XrInteractionProfileSuggestedBinding* suggested) {
    if (session().attached) return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
    const std::string profile = pathTexts()[suggested->interactionProfile - 1];
    const KnownProfile* known = knownProfile(profile);
    if (!known || (known->extension && !shoalFakeRuntime().enabled.contains(known->extension))) {
        shoalFakeRuntime().complain(profile + ": not known, or its extension is not enabled");
        return XR_ERROR_PATH_UNSUPPORTED;
    }
    shoalFakeRuntime().boundProfiles.push_back(profile);
    // Inputs that an action may be bound to, by its type.
    for (uint32_t i = 0; i < suggested->countSuggestedBindings; ++i) {
        const XrActionSuggestedBinding& binding = suggested->suggestedBindings[i];
        const std::string path = pathTexts()[binding.binding - 1];
        const XrActionType type = objectOf<FakeAction>(binding.action).type;
        const bool fits = type == XR_ACTION_TYPE_POSE_INPUT         ? path.ends_with("/pose")
                          : type == XR_ACTION_TYPE_VIBRATION_OUTPUT ? path.ends_with("/output/haptic")
                          : type == XR_ACTION_TYPE_BOOLEAN_INPUT
                              ? path.ends_with("/click")
                              : path.ends_with("/click") || path.ends_with("/value");
        if (!has(*known, path)) shoalFakeRuntime().complain(profile + " has no " + path);
        if (!fits) shoalFakeRuntime().complain(profile + ": " + path + " does not fit its action");
    }
    return XR_SUCCESS;
}
FAKE_XR(xrAttachSessionActionSets, XrSession, const XrSessionActionSetsAttachInfo*) {
    if (session().attached) return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
    session().attached = true;
    return XR_SUCCESS;
}
FAKE_XR(xrSyncActions, XrSession, const XrActionsSyncInfo*) {
    if (!session().attached) return XR_ERROR_ACTIONSET_NOT_ATTACHED;
    return shoalFakeRuntime().state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}
FAKE_XR(xrCreateActionSpace, XrSession, const XrActionSpaceCreateInfo* info, XrSpace* out) {
    const int hand = handOf(info->subactionPath);
    if (hand < 0) return XR_ERROR_PATH_UNSUPPORTED;
    ++shoalFakeRuntime().spaces;
    *out = handleOf<XrSpace>(
        new FakeSpace{hand, XR_REFERENCE_SPACE_TYPE_LOCAL, placeOf(info->poseInActionSpace)});
    return XR_SUCCESS;
}

// Returns a hand's controller; for a path that is no hand's, one that is not active.
const FakeController& controllerOf(const XrActionStateGetInfo* info) {
    static const FakeController none;
    const int hand = handOf(info->subactionPath);
    return hand < 0 ? none : shoalFakeRuntime().controllers[static_cast<size_t>(hand)];
}

FAKE_XR(xrGetActionStatePose, XrSession, const XrActionStateGetInfo* info, XrActionStatePose* out) {
    out->isActive = controllerOf(info).active;
    return XR_SUCCESS;
}
FAKE_XR(xrGetActionStateFloat, XrSession, const XrActionStateGetInfo* info, XrActionStateFloat* out) {
    const FakeController& controller = controllerOf(info);
    out->isActive = controller.active;
    if (out->isActive)
        out->currentState =
            objectOf<FakeAction>(info->action).name == "close" ? controller.squeeze : controller.trigger;
    return XR_SUCCESS;
}
FAKE_XR(xrGetActionStateBoolean, XrSession, const XrActionStateGetInfo* info, XrActionStateBoolean* out) {
    out->isActive = controllerOf(info).active;
    out->currentState = out->isActive && controllerOf(info).menu;
    return XR_SUCCESS;
}
FAKE_XR(xrApplyHapticFeedback, XrSession, const XrHapticActionInfo* info, const XrHapticBaseHeader* haptic) {
    if (shoalFakeRuntime().state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
    const auto& vibration = reinterpret_cast<const XrHapticVibration&>(*haptic);
    if (vibration.type != XR_TYPE_HAPTIC_VIBRATION ||
        !(vibration.amplitude >= 0 && vibration.amplitude <= 1) || vibration.frequency < 0 ||
        vibration.duration <= 0)
        shoalFakeRuntime().complain("xrApplyHapticFeedback: out of range");
    shoalFakeRuntime().pulses.push_back(
        {handOf(info->subactionPath), vibration.amplitude, vibration.frequency, vibration.duration});
    return XR_SUCCESS;
}
FAKE_XR(xrStopHapticFeedback, XrSession, const XrHapticActionInfo* info) {
    if (shoalFakeRuntime().state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
    shoalFakeRuntime().pulses.push_back({handOf(info->subactionPath)});
    return XR_SUCCESS;
}

FAKE_XR(xrCreateHandTrackerEXT, XrSession, const XrHandTrackerCreateInfoEXT* info, XrHandTrackerEXT* out) {
    FakeRuntime& fake = shoalFakeRuntime();
    FakeHand& hand = fake.hands[info->hand == XR_HAND_LEFT_EXT ? 0 : 1];
    const auto* source = static_cast<const XrHandTrackingDataSourceInfoEXT*>(info->next);
    if (source && (source->type != XR_TYPE_HAND_TRACKING_DATA_SOURCE_INFO_EXT ||
                   !fake.enabled.contains(XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME)))
        fake.complain("xrCreateHandTrackerEXT: something is chained that is not known or not enabled");
    if (source && !fake.tellsDataSources) return XR_ERROR_FEATURE_UNSUPPORTED;
    hand.bareAlone = source && source->requestedDataSourceCount == 1 &&
                     source->requestedDataSources[0] == XR_HAND_TRACKING_DATA_SOURCE_UNOBSTRUCTED_EXT;
    ++fake.handTrackers;
    *out = handleOf<XrHandTrackerEXT>(&hand);
    return XR_SUCCESS;
}
FAKE_XR(xrDestroyHandTrackerEXT, XrHandTrackerEXT) {
    --shoalFakeRuntime().handTrackers;
    return XR_SUCCESS;
}
FAKE_XR(xrLocateHandJointsEXT, XrHandTrackerEXT tracker, const XrHandJointsLocateInfoEXT* info,
        XrHandJointLocationsEXT* out) {
    const FakeHand& hand = objectOf<FakeHand>(tracker);
    if (out->jointCount != XR_HAND_JOINT_COUNT_EXT) return XR_ERROR_VALIDATION_FAILURE;
    out->isActive = hand.active && !(hand.isMadeUp && hand.bareAlone);
    if (!out->isActive) return XR_SUCCESS;
    const Place baseFromLocal = inverse(localFromSpace(info->baseSpace));
    for (size_t i = 0; i < hand.joints.size(); ++i) {
        out->jointLocations[i] = hand.joints[i];
        out->jointLocations[i].pose = poseOf(baseFromLocal * placeOf(hand.joints[i].pose));
    }
    return XR_SUCCESS;
}

} // namespace

} // namespace shoal::test
