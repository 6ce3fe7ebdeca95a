// Actions of controllers, bare hands, and what is felt.
#include "tests/gl/xr/runtime/State.h"

namespace shoal::test {

namespace {

int handOf(XrPath path) {
    if (path < 1 || path > pathTexts().size()) return -1;
    return pathTexts()[path - 1] == "/user/hand/left"    ? 0
           : pathTexts()[path - 1] == "/user/hand/right" ? 1
                                                         : -1;
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
    shoalFakeRuntime().boundProfiles.push_back(profile);
    // What each action may be bound to, by its type.
    for (uint32_t i = 0; i < suggested->countSuggestedBindings; ++i) {
        const XrActionSuggestedBinding& binding = suggested->suggestedBindings[i];
        const std::string path = pathTexts()[binding.binding - 1];
        const XrActionType type = objectOf<FakeAction>(binding.action).type;
        const bool fits = type == XR_ACTION_TYPE_POSE_INPUT         ? path.ends_with("/pose")
                          : type == XR_ACTION_TYPE_VIBRATION_OUTPUT ? path.ends_with("/output/haptic")
                          : type == XR_ACTION_TYPE_BOOLEAN_INPUT
                              ? path.ends_with("/click")
                              : path.ends_with("/click") || path.ends_with("/value");
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
    *out = handleOf<XrSpace>(new FakeSpace{hand, placeOf(info->poseInActionSpace)});
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
    ++shoalFakeRuntime().handTrackers;
    *out = handleOf<XrHandTrackerEXT>(&shoalFakeRuntime().hands[info->hand == XR_HAND_LEFT_EXT ? 0 : 1]);
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
    out->isActive = hand.active;
    if (!hand.active) return XR_SUCCESS;
    const Place baseFromLocal = inverse(localFromSpace(info->baseSpace));
    for (size_t i = 0; i < hand.joints.size(); ++i) {
        out->jointLocations[i] = hand.joints[i];
        out->jointLocations[i].pose = poseOf(baseFromLocal * placeOf(hand.joints[i].pose));
    }
    return XR_SUCCESS;
}

} // namespace

PFN_xrVoidFunction inputFunction(const std::string& name) {
#define GIVE(function)                                                                                       \
    if (name == #function) return reinterpret_cast<PFN_xrVoidFunction>(function)
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
#undef GIVE
    return nullptr;
}

} // namespace shoal::test
