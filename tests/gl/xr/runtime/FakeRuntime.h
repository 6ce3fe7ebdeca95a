// An OpenXR runtime for tests: a shared library that the real loader loads by XR_RUNTIME_JSON. Its headset
// does what a test tells it, records what it was shown, and complains of calls out of order. Its time is
// simulated, so that nothing waits.
//
// A test reaches it in its own process by loading the same library: fakeRuntime() is the one in use.
#pragma once

#define XR_USE_GRAPHICS_API_OPENGL
#include "engine/xr/NewerOpenXr.h"

#include <epoxy/gl.h>
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace shoal::test {

struct FakeHand {
    bool active = false;
    bool isMadeUp = false;  // joints are derived from a controller that the hand holds
    bool bareAlone = false; // its tracker asked for joints that are not made up
    std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{}; // in LOCAL's frame
};

struct FakeController {
    bool active = false;
    XrPosef grip{{0, 0, 0, 1}, {0, 0, 0}}; // in LOCAL's frame
    float squeeze = 0, trigger = 0;
    bool menu = false;
};

struct ShownDepth {
    float minimum, maximum, near_m, far_m;
    XrRect2Di rect;
    std::vector<float> values; // with keepPictures: the rect's part, lowest row first
};

struct ShownEye {
    XrPosef localFromEye;
    XrFovf fov;
    XrRect2Di rect;
    std::vector<uint8_t> rgba; // with keepPictures: the rect's part, lowest row first
    std::optional<ShownDepth> depth;
};

struct ShownPanel {
    XrPosef localFromPanel;
    XrExtent2Df size;
    XrRect2Di rect;
    std::vector<uint8_t> rgba; // likewise
};

struct ShownFrame {
    XrTime display = 0;
    XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_MAX_ENUM;
    XrCompositionLayerFlags eyesFlags = 0;
    std::optional<std::array<ShownEye, 2>> eyes;
    std::optional<ShownPanel> panel;
};

struct FeltPulse {
    int hand = 0;
    float amplitude = 0, frequency_Hz = 0; // amplitude 0: a stop
    XrDuration duration = 0;
};

struct FakeRuntime {
    // Properties of the headset. A test may change all of them, also in onWait.
    bool present = true; // a headset is plugged in
    std::set<std::string> extensions = {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME,
                                        XR_EXT_HAND_TRACKING_EXTENSION_NAME};
    std::map<std::string, XrResult> failing; // result that a function, by name, returns at once
    std::vector<int64_t> formats = {GL_RGBA16F, GL_SRGB8_ALPHA8, GL_RGBA8};
    std::vector<XrEnvironmentBlendMode> blendModes = {XR_ENVIRONMENT_BLEND_MODE_ADDITIVE,
                                                      XR_ENVIRONMENT_BLEND_MODE_OPAQUE};
    uint32_t eyeWidth = 200, eyeHeight = 240;
    XrVersion minOpenGl = XR_MAKE_VERSION(3, 3, 0);
    // Spaces on offer, in LOCAL's frame; LOCAL_FLOOR with XR_EXT_local_floor.
    std::map<XrReferenceSpaceType, XrPosef> referenceSpaces = {
        {XR_REFERENCE_SPACE_TYPE_LOCAL, {{0, 0, 0, 1}, {0, 0, 0}}}};
    XrSpaceLocationFlags spaceFlags = 0xf; // of all but LOCAL
    std::array<XrView, 2> views;           // in LOCAL's frame
    XrViewStateFlags viewFlags = 0xf;
    std::array<FakeHand, 2> hands;
    std::array<FakeController, 2> controllers;
    double period_s = 1.0 / 90;
    std::vector<float> refreshRates_Hz = {72, 80, 90, 120}; // with XR_FB_display_refresh_rate
    float refreshRate_Hz = 72;
    bool shouldRender = true;
    bool tellsDataSources = true;               // of hands; false: asking for them fails
    bool sensesWearer = true;                   // with XR_EXT_user_presence
    bool keepPictures = false;                  // of the eyes and the panel, each frame anew
    std::function<void(FakeRuntime&)> onWait;   // in each xrWaitFrame, before it answers
    std::function<void(FakeRuntime&)> onCreate; // in each xrCreateInstance, before it answers
    std::function<void(FakeRuntime&)> onGone;   // when the last instance has been destroyed

    // Queues an event for xrPollEvent.
    template <class Event> void say(const Event& event) {
        static_assert(sizeof(Event) <= sizeof(XrEventDataBuffer));
        std::memcpy(&events.emplace_back(), &event, sizeof event);
    }
    void say(XrSessionState state);
    void sayExit(); // as if the player left in the runtime's menu
    void sayInstanceLoss();
    void sayRecentred(XrReferenceSpaceType which = XR_REFERENCE_SPACE_TYPE_LOCAL, XrTime when = 0);
    void sayWorn(bool worn);

    // Calls and pictures that it saw.
    std::vector<std::string> complaints; // about calls that the specification forbids
    std::set<std::string> called;
    std::set<std::string> enabled; // extensions, of the last instance
    std::vector<FeltPulse> pulses;
    std::vector<std::string> boundProfiles; // interaction profiles with suggested bindings
    uint64_t framesWaited = 0, framesEnded = 0, framesWithEyes = 0;
    XrSessionState state = XR_SESSION_STATE_UNKNOWN; // last one reported
    bool running = false, exitRequested = false;
    int instances = 0, sessions = 0, swapchains = 0, spaces = 0, handTrackers = 0; // alive
    ShownFrame last;

    FakeRuntime();
    void complain(const std::string& what) { complaints.push_back(what); }

    std::deque<XrEventDataBuffer> events; // events that were not polled yet
};

} // namespace shoal::test

extern "C" shoal::test::FakeRuntime& shoalFakeRuntime();
