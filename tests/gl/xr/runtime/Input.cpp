// Actions of controllers, tracking of bare hands, and haptics.
#include "tests/gl/xr/runtime/State.h"

#include <algorithm>
#include <cstring>

namespace shoal::test {

namespace {

int handOf(XrPath path) {
    if (path < 1 || path > pathTexts().size()) return -1;
    return pathTexts()[path - 1] == "/user/hand/left"    ? 0
           : pathTexts()[path - 1] == "/user/hand/right" ? 1
                                                         : -1;
}

// Inputs of the registry's interaction profiles (xr.xml, 1.1.53) for games, no poses or haptics.
struct KnownProfile {
    const char* extension; // null: OpenXR 1.0
    const char* name;
    std::set<std::string> both, left; // below /input
    bool haptic = true;
};
const std::vector<KnownProfile>& knownProfiles() {
    static const std::vector<KnownProfile> known = {
        {nullptr, "khr/simple_controller", {"select/click", "menu/click"}, {}},
        {nullptr, "oculus/touch_controller", {"squeeze/value", "trigger/value"}, {"menu/click"}},
        {nullptr,
         "valve/index_controller",
         {"squeeze/value", "trigger/value", "trigger/click", "b/click"},
         {}},
        {nullptr,
         "htc/vive_controller",
         {"squeeze/click", "trigger/value", "trigger/click", "menu/click"},
         {}},
        {nullptr, "microsoft/motion_controller", {"squeeze/click", "trigger/value", "menu/click"}, {}},
        {"XR_EXT_hand_interaction",
         "ext/hand_interaction_ext",
         {"grasp_ext/value", "pinch_ext/value"},
         {},
         false},
        {"XR_FB_touch_controller_pro",
         "facebook/touch_controller_pro",
         {"squeeze/value", "trigger/value"},
         {"menu/click"}},
        {"XR_META_touch_controller_plus",
         "meta/touch_controller_plus",
         {"squeeze/value", "trigger/value"},
         {"menu/click"}},
        {"XR_BD_controller_interaction",
         "bytedance/pico_neo3_controller",
         {"squeeze/value", "squeeze/click", "trigger/value", "trigger/click", "menu/click"},
         {}},
        {"XR_BD_controller_interaction",
         "bytedance/pico4_controller",
         {"squeeze/value", "squeeze/click", "trigger/value", "trigger/click"},
         {"menu/click"}},
        {"XR_BD_ultra_controller_interaction",
         "bytedance/pico_ultra_controller_bd",
         {"squeeze/value", "squeeze/click", "trigger/value", "trigger/click"},
         {"menu/click"}},
        {"XR_HTC_vive_focus3_controller_interaction",
         "htc/vive_focus3_controller",
         {"squeeze/value", "squeeze/click", "trigger/value", "trigger/click"},
         {"menu/click"}},
        {"XR_EXT_hp_mixed_reality_controller",
         "hp/mixed_reality_controller",
         {"squeeze/value", "trigger/value", "menu/click"},
         {}},
    };
    return known;
}
const KnownProfile* knownProfile(const std::string& path) {
    const auto& known = knownProfiles();
    const auto at = std::ranges::find_if(
        known, [&](const KnownProfile& p) { return path == std::string("/interaction_profiles/") + p.name; });
    return at == known.end() ? nullptr : &*at;
}
bool has(const KnownProfile& profile, const std::string& path) {
    for (const char* hand : {"/user/hand/left", "/user/hand/right"}) {
        if (!path.starts_with(hand)) continue;
        const std::string below = path.substr(std::strlen(hand));
        if (below == "/input/grip/pose") return true;
        if (below == "/output/haptic") return profile.haptic;
        if (!below.starts_with("/input/")) return false;
        const std::string component = below.substr(std::strlen("/input/"));
        return profile.both.contains(component) ||
               (path.starts_with("/user/hand/left") && profile.left.contains(component));
    }
    return false;
}

struct ActionSet {
    std::vector<std::unique_ptr<FakeAction>> actions;
};

XrResult xrCreateActionSet(XrInstance, const XrActionSetCreateInfo*, XrActionSet* out) {
    FAKE_XR(xrCreateActionSet);
    *out = handleOf<XrActionSet>(new ActionSet);
    return XR_SUCCESS;
}
XrResult xrDestroyActionSet(XrActionSet set) {
    FAKE_XR(xrDestroyActionSet);
    delete &objectOf<ActionSet>(set);
    return XR_SUCCESS;
}
XrResult xrCreateAction(XrActionSet set, const XrActionCreateInfo* info, XrAction* out) {
    FAKE_XR(xrCreateAction);
    auto& actions = objectOf<ActionSet>(set).actions;
    actions.push_back(std::make_unique<FakeAction>(FakeAction{info->actionType, info->actionName}));
    *out = handleOf<XrAction>(actions.back().get());
    return XR_SUCCESS;
}
XrResult xrDestroyAction(XrAction) {
    FAKE_XR(xrDestroyAction);
    return XR_SUCCESS;
}
XrResult xrSuggestInteractionProfileBindings(XrInstance,
                                             const XrInteractionProfileSuggestedBinding* suggested) {
    FAKE_XR(xrSuggestInteractionProfileBindings);
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
XrResult xrAttachSessionActionSets(XrSession, const XrSessionActionSetsAttachInfo*) {
    FAKE_XR(xrAttachSessionActionSets);
    if (session().attached) return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
    session().attached = true;
    return XR_SUCCESS;
}
XrResult xrSyncActions(XrSession, const XrActionsSyncInfo*) {
    FAKE_XR(xrSyncActions);
    if (!session().attached) return XR_ERROR_ACTIONSET_NOT_ATTACHED;
    return shoalFakeRuntime().state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}
XrResult xrCreateActionSpace(XrSession, const XrActionSpaceCreateInfo* info, XrSpace* out) {
    FAKE_XR(xrCreateActionSpace);
    const int hand = handOf(info->subactionPath);
    if (hand < 0) return XR_ERROR_PATH_UNSUPPORTED;
    ++shoalFakeRuntime().spaces;
    *out = handleOf<XrSpace>(
        new FakeSpace{hand, XR_REFERENCE_SPACE_TYPE_LOCAL, placeOf(info->poseInActionSpace)});
    return XR_SUCCESS;
}

const FakeController* controllerOf(const XrActionStateGetInfo* info) {
    const int hand = handOf(info->subactionPath);
    return hand < 0 ? nullptr : &shoalFakeRuntime().controllers[static_cast<size_t>(hand)];
}

XrResult xrGetActionStatePose(XrSession, const XrActionStateGetInfo* info, XrActionStatePose* out) {
    FAKE_XR(xrGetActionStatePose);
    const FakeController* controller = controllerOf(info);
    out->isActive = controller && controller->active;
    return XR_SUCCESS;
}
XrResult xrGetActionStateFloat(XrSession, const XrActionStateGetInfo* info, XrActionStateFloat* out) {
    FAKE_XR(xrGetActionStateFloat);
    const FakeController* controller = controllerOf(info);
    out->isActive = controller && controller->active;
    if (out->isActive)
        out->currentState =
            objectOf<FakeAction>(info->action).name == "close" ? controller->squeeze : controller->trigger;
    return XR_SUCCESS;
}
XrResult xrGetActionStateBoolean(XrSession, const XrActionStateGetInfo* info, XrActionStateBoolean* out) {
    FAKE_XR(xrGetActionStateBoolean);
    const FakeController* controller = controllerOf(info);
    out->isActive = controller && controller->active;
    out->currentState = out->isActive && controller->menu;
    return XR_SUCCESS;
}
XrResult xrApplyHapticFeedback(XrSession, const XrHapticActionInfo* info, const XrHapticBaseHeader* haptic) {
    FAKE_XR(xrApplyHapticFeedback);
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
XrResult xrStopHapticFeedback(XrSession, const XrHapticActionInfo* info) {
    FAKE_XR(xrStopHapticFeedback);
    if (shoalFakeRuntime().state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
    shoalFakeRuntime().pulses.push_back({handOf(info->subactionPath)});
    return XR_SUCCESS;
}

XrResult xrCreateHandTrackerEXT(XrSession, const XrHandTrackerCreateInfoEXT* info, XrHandTrackerEXT* out) {
    FAKE_XR(xrCreateHandTrackerEXT);
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
XrResult xrDestroyHandTrackerEXT(XrHandTrackerEXT) {
    FAKE_XR(xrDestroyHandTrackerEXT);
    --shoalFakeRuntime().handTrackers;
    return XR_SUCCESS;
}
XrResult xrLocateHandJointsEXT(XrHandTrackerEXT tracker, const XrHandJointsLocateInfoEXT* info,
                               XrHandJointLocationsEXT* out) {
    FAKE_XR(xrLocateHandJointsEXT);
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

PFN_xrVoidFunction inputFunction(const std::string& name) {
    GIVE(xrCreateActionSet);
    GIVE(xrDestroyActionSet);
    GIVE(xrCreateAction);
    GIVE(xrDestroyAction);
    GIVE(xrSuggestInteractionProfileBindings);
    GIVE(xrAttachSessionActionSets);
    GIVE(xrSyncActions);
    GIVE(xrCreateActionSpace);
    GIVE(xrGetActionStatePose);
    GIVE(xrGetActionStateFloat);
    GIVE(xrGetActionStateBoolean);
    GIVE(xrApplyHapticFeedback);
    GIVE(xrStopHapticFeedback);
    GIVE(xrCreateHandTrackerEXT);
    GIVE(xrDestroyHandTrackerEXT);
    GIVE(xrLocateHandJointsEXT);
    return nullptr;
}

} // namespace shoal::test
