#include "engine/xr/OpenXr.h"

namespace shoal::xr {

// Bindings of a controller: squeeze closes the hand, trigger bends the index finger, menu pauses. A
// controller with one button uses it for the first two. Names are those of OpenXR's registry.
struct InteractionProfile {
    const char* extension; // the extension that defines it; null: OpenXR 1.0
    const char* name;
    bool menuOnRight = false; // both hands have a menu button; false: only the left
    const char* squeeze = "squeeze/value";
    const char* trigger = "trigger/value";
    const char* menu = "menu/click"; // null: none
    bool vibrates = true;
};
constexpr const char* kPico = "XR_BD_controller_interaction";
constexpr InteractionProfile kProfiles[] = {
    {nullptr, "khr/simple_controller", true, "select/click", "select/click"},
    {nullptr, "oculus/touch_controller"},
    {nullptr, "valve/index_controller", true, "squeeze/value", "trigger/value", "b/click"},
    {nullptr, "htc/vive_controller", true, "squeeze/click"},
    {nullptr, "microsoft/motion_controller", true, "squeeze/click"},
    // Bare hands as the runtime interprets them, for runtimes that do not give their joints.
    {"XR_EXT_hand_interaction", "ext/hand_interaction_ext", false, "grasp_ext/value", "pinch_ext/value",
     nullptr, false},
    {"XR_FB_touch_controller_pro", "facebook/touch_controller_pro"},
    {"XR_META_touch_controller_plus", "meta/touch_controller_plus"},
    {kPico, "bytedance/pico_neo3_controller", true},
    {kPico, "bytedance/pico4_controller"},
    {"XR_BD_ultra_controller_interaction", "bytedance/pico_ultra_controller_bd"},
    {"XR_HTC_vive_focus3_controller_interaction", "htc/vive_focus3_controller"},
    {"XR_EXT_hp_mixed_reality_controller", "hp/mixed_reality_controller", true},
};

constexpr std::array<const char*, 2> kHands = {"/user/hand/left", "/user/hand/right"};

static XrPath pathOf(XrInstance instance, const std::string& text) {
    return written(XrPath{}, "xrStringToPath", xrStringToPath, instance, text.c_str());
}

std::vector<const char*> Actions::extensions() {
    std::vector<const char*> names;
    for (const InteractionProfile& profile : kProfiles)
        if (profile.extension && (names.empty() || names.back() != profile.extension))
            names.push_back(profile.extension);
    return names;
}

Actions::Actions(const Instance& connection, XrSession session) {
    const XrInstance instance = connection.handle.get();
    for (size_t i = 0; i < 2; ++i) hands_[i] = pathOf(instance, kHands[i]);
    const XrActionSetCreateInfo setInfo{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "dive", "Dive"};
    const XrActionSet set =
        written(XrActionSet{}, "xrCreateActionSet", xrCreateActionSet, instance, &setInfo);
    set_.reset(set);

    const XrPath* const hands = hands_.data();
    constexpr auto kType = XR_TYPE_ACTION_CREATE_INFO;
    const auto create = [&](XrAction& action, const XrActionCreateInfo& info) {
        SHOAL_XR(xrCreateAction(set, &info, &action));
    };
    create(grip_, {kType, nullptr, "hand", XR_ACTION_TYPE_POSE_INPUT, 2, hands, "Hand"});
    create(squeeze_, {kType, nullptr, "close", XR_ACTION_TYPE_FLOAT_INPUT, 2, hands, "Close the hand"});
    create(trigger_,
           {kType, nullptr, "index", XR_ACTION_TYPE_FLOAT_INPUT, 2, hands, "Bend the index finger"});
    create(menu_, {kType, nullptr, "pause", XR_ACTION_TYPE_BOOLEAN_INPUT, 2, hands, "Pause"});
    create(haptic_, {kType, nullptr, "feel", XR_ACTION_TYPE_VIBRATION_OUTPUT, 2, hands, "Feel"});

    for (const InteractionProfile& profile : kProfiles) {
        if (profile.extension && !connection.uses(profile.extension)) continue;
        std::vector<XrActionSuggestedBinding> bindings;
        for (size_t hand = 0; hand < 2; ++hand) {
            const auto bind = [&](XrAction action, const std::string& below) {
                bindings.push_back({action, pathOf(instance, std::string(kHands[hand]) + below)});
            };
            const std::string input = "/input/";
            bind(grip_, "/input/grip/pose");
            bind(squeeze_, input + profile.squeeze);
            bind(trigger_, input + profile.trigger);
            if (profile.vibrates) bind(haptic_, "/output/haptic");
            if (profile.menu && (hand == 0 || profile.menuOnRight)) bind(menu_, input + profile.menu);
        }
        const XrInteractionProfileSuggestedBinding suggested{
            XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
            pathOf(instance, std::string("/interaction_profiles/") + profile.name),
            static_cast<uint32_t>(bindings.size()), bindings.data()};
        const XrResult result = xrSuggestInteractionProfileBindings(instance, &suggested);
        if (result != XR_ERROR_PATH_UNSUPPORTED) // a runtime without that controller
            check(result, "xrSuggestInteractionProfileBindings");
    }
    for (size_t i = 0; i < 2; ++i) {
        const XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, grip_, hands_[i],
                                           poseTo({})};
        gripSpaces_[i].reset(written(XrSpace{}, "xrCreateActionSpace", xrCreateActionSpace, session, &info));
    }
    const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
    SHOAL_XR(xrAttachSessionActionSets(session, &attach));
}

void Actions::locate(XrSession session, XrSpace world, XrTime time, std::array<Controller, 2>& out) const {
    const XrActiveActionSet active{set_.get(), XR_NULL_PATH};
    const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
    const XrResult synced = SHOAL_XR(xrSyncActions(session, &sync));
    for (size_t i = 0; i < 2; ++i) {
        Controller& controller = out[i];
        controller = {};
        if (synced == XR_SESSION_NOT_FOCUSED) continue;
        XrActionStateGetInfo ask{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, grip_, hands_[i]};
        XrActionStatePose held{XR_TYPE_ACTION_STATE_POSE};
        SHOAL_XR(xrGetActionStatePose(session, &ask, &held));
        if (!held.isActive) continue;
        controller.worldFromGrip = poseOf(gripSpaces_[i].get(), world, time);
        for (const auto& [action, value] :
             {std::pair(squeeze_, &controller.squeeze), std::pair(trigger_, &controller.trigger)}) {
            XrActionStateFloat state{XR_TYPE_ACTION_STATE_FLOAT};
            ask.action = action;
            SHOAL_XR(xrGetActionStateFloat(session, &ask, &state));
            if (state.isActive) *value = state.currentState >= 0 ? std::min(state.currentState, 1.0f) : 0;
        }
        XrActionStateBoolean menu{XR_TYPE_ACTION_STATE_BOOLEAN};
        ask.action = menu_;
        SHOAL_XR(xrGetActionStateBoolean(session, &ask, &menu));
        controller.menu = menu.isActive && menu.currentState;
    }
}

void Actions::vibrate(XrSession session, int hand, float amplitude, float frequency_Hz) const {
    const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, haptic_, hands_[hand]};
    if (!(amplitude > 0)) {
        SHOAL_XR(xrStopHapticFeedback(session, &info));
        return;
    }
    constexpr XrDuration kLongest_ns = 100'000'000; // more than a frame; it ends soon if the game dies
    const XrHapticVibration vibration{XR_TYPE_HAPTIC_VIBRATION, nullptr, kLongest_ns, frequency_Hz,
                                      std::min(amplitude, 1.0f)};
    SHOAL_XR(xrApplyHapticFeedback(session, &info, reinterpret_cast<const XrHapticBaseHeader*>(&vibration)));
}

} // namespace shoal::xr
