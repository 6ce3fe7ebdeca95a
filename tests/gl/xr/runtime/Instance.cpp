// Negotiation with the loader, the instance, its headset, paths and events.
#include "tests/gl/xr/runtime/State.h"

#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <cstring>

namespace shoal::test {

Place placeOf(const XrPosef& pose) {
    return {{pose.position.x, pose.position.y, pose.position.z},
            glm::quat(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z)};
}
XrPosef poseOf(const Place& place) {
    const auto& [p, q] = place;
    return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

std::map<std::string, PFN_xrVoidFunction>& functions() {
    static std::map<std::string, PFN_xrVoidFunction> all;
    return all;
}

std::vector<std::string>& pathTexts() {
    static std::vector<std::string> texts;
    return texts;
}

FakeRuntime::FakeRuntime() {
    for (size_t eye = 0; eye < 2; ++eye) {
        const float side = eye == 0 ? -1.0f : 1.0f;
        views[eye] = {XR_TYPE_VIEW};
        views[eye].pose = {{0, 0, 0, 1}, {side * 0.032f, 0, 0}};
        // Angles as headsets have them: farther outwards than inwards, farther down than up.
        views[eye].fov = {eye == 0 ? -0.85f : -0.75f, eye == 0 ? 0.75f : 0.85f, 0.80f, -0.90f};
    }
}

void FakeRuntime::say(XrSessionState next) {
    state = next;
    say(XrEventDataSessionStateChanged{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr,
                                       handleOf<XrSession>(&session()), next, 0});
}
void FakeRuntime::sayExit() {
    exitRequested = true;
    say(XR_SESSION_STATE_VISIBLE);
    say(XR_SESSION_STATE_SYNCHRONIZED);
    say(XR_SESSION_STATE_STOPPING);
}
void FakeRuntime::sayInstanceLoss() {
    say(XrEventDataInstanceLossPending{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, nullptr, 0});
}
void FakeRuntime::sayRecentred(XrReferenceSpaceType which, XrTime when) {
    constexpr XrPosef kUnknown{{0, 0, 0, 1}, {0, 0, 0}};
    say(XrEventDataReferenceSpaceChangePending{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING, nullptr,
                                               handleOf<XrSession>(&session()), which, when, XR_FALSE,
                                               kUnknown});
}
void FakeRuntime::sayWorn(bool worn) {
    say(XrEventDataUserPresenceChangedEXT{XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT, nullptr,
                                          handleOf<XrSession>(&session()), worn});
}

namespace {

using std::strncpy;

FAKE_XR(xrEnumerateInstanceExtensionProperties, const char*, uint32_t capacity, uint32_t* count,
        XrExtensionProperties* items) {
    std::vector<XrExtensionProperties> offered;
    for (const std::string& name : shoalFakeRuntime().extensions) {
        offered.push_back({XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 1});
        strncpy(offered.back().extensionName, name.c_str(), XR_MAX_EXTENSION_NAME_SIZE - 1);
    }
    return giveList(offered, capacity, count, items);
}

FAKE_XR(xrCreateInstance, const XrInstanceCreateInfo* info, XrInstance* instance) {
    for (uint32_t i = 0; i < info->enabledExtensionCount; ++i)
        if (!shoalFakeRuntime().extensions.contains(info->enabledExtensionNames[i]))
            return XR_ERROR_EXTENSION_NOT_PRESENT;
    shoalFakeRuntime().enabled = {info->enabledExtensionNames,
                                  info->enabledExtensionNames + info->enabledExtensionCount};
    ++shoalFakeRuntime().instances;
    *instance = handleOf<XrInstance>(&shoalFakeRuntime());
    return XR_SUCCESS;
}
FAKE_XR(xrDestroyInstance, XrInstance) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (--fake.instances == 0 && fake.onGone) fake.onGone(fake);
    return XR_SUCCESS;
}
FAKE_XR(xrGetInstanceProperties, XrInstance, XrInstanceProperties* out) {
    strncpy(out->runtimeName, "Fake runtime", XR_MAX_RUNTIME_NAME_SIZE - 1);
    out->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
    return XR_SUCCESS;
}
FAKE_XR(xrPollEvent, XrInstance, XrEventDataBuffer* out) {
    auto& events = shoalFakeRuntime().events;
    if (out->type != XR_TYPE_EVENT_DATA_BUFFER) shoalFakeRuntime().complain("xrPollEvent: no type");
    if (events.empty()) return XR_EVENT_UNAVAILABLE;
    *out = events.front();
    events.pop_front();
    return XR_SUCCESS;
}

#define CASE(name, value)                                                                                    \
    case name:                                                                                               \
        text = #name;                                                                                        \
        break;
FAKE_XR(xrStructureTypeToString, XrInstance, XrStructureType value, char out[XR_MAX_STRUCTURE_NAME_SIZE]) {
    const char* text = "XR_UNKNOWN";
    switch (value) { XR_LIST_ENUM_XrStructureType(CASE) default : break; }
    strncpy(out, text, XR_MAX_STRUCTURE_NAME_SIZE);
    return XR_SUCCESS;
}
#undef CASE

FAKE_XR(xrGetSystem, XrInstance, const XrSystemGetInfo* info, XrSystemId* out) {
    if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY) return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
    if (!shoalFakeRuntime().present) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
    *out = 1;
    return XR_SUCCESS;
}
FAKE_XR(xrGetSystemProperties, XrInstance, XrSystemId, XrSystemProperties* out) {
    out->systemId = 1;
    strncpy(out->systemName, "Fake headset", XR_MAX_SYSTEM_NAME_SIZE - 1);
    out->graphicsProperties = {4096, 4096, 16};
    out->trackingProperties = {XR_TRUE, XR_TRUE};
    FakeRuntime& fake = shoalFakeRuntime();
    for (auto* next = static_cast<XrBaseOutStructure*>(out->next); next; next = next->next) {
        const bool hands = next->type == XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT;
        const bool presence = next->type == XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT;
        if (hands) reinterpret_cast<XrSystemHandTrackingPropertiesEXT*>(next)->supportsHandTracking = XR_TRUE;
        if (presence)
            reinterpret_cast<XrSystemUserPresencePropertiesEXT*>(next)->supportsUserPresence =
                fake.sensesWearer;
        if ((hands && !fake.enabled.contains(XR_EXT_HAND_TRACKING_EXTENSION_NAME)) ||
            (presence && !fake.enabled.contains(XR_EXT_USER_PRESENCE_EXTENSION_NAME)))
            fake.complain("xrGetSystemProperties: of an extension that is not enabled");
    }
    return XR_SUCCESS;
}
FAKE_XR(xrEnumerateViewConfigurationViews, XrInstance, XrSystemId, XrViewConfigurationType, uint32_t capacity,
        uint32_t* count, XrViewConfigurationView* items) {
    XrViewConfigurationView view{XR_TYPE_VIEW_CONFIGURATION_VIEW};
    view.recommendedImageRectWidth = shoalFakeRuntime().eyeWidth;
    view.recommendedImageRectHeight = shoalFakeRuntime().eyeHeight;
    view.maxImageRectWidth = view.maxImageRectHeight = 4096;
    view.recommendedSwapchainSampleCount = view.maxSwapchainSampleCount = 1;
    return giveList(std::array{view, view}, capacity, count, items);
}
FAKE_XR(xrEnumerateEnvironmentBlendModes, XrInstance, XrSystemId, XrViewConfigurationType, uint32_t capacity,
        uint32_t* count, XrEnvironmentBlendMode* items) {
    return giveList(shoalFakeRuntime().blendModes, capacity, count, items);
}
FAKE_XR(xrGetOpenGLGraphicsRequirementsKHR, XrInstance, XrSystemId, XrGraphicsRequirementsOpenGLKHR* out) {
    out->minApiVersionSupported = shoalFakeRuntime().minOpenGl;
    out->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
    return XR_SUCCESS;
}
FAKE_XR(xrStringToPath, XrInstance, const char* text, XrPath* out) {
    auto& texts = pathTexts();
    const auto at = std::find(texts.begin(), texts.end(), text);
    *out = static_cast<XrPath>(at - texts.begin()) + 1;
    if (at == texts.end()) texts.emplace_back(text);
    return XR_SUCCESS;
}

FAKE_XR(xrGetInstanceProcAddr, XrInstance, const char* name, PFN_xrVoidFunction* out) {
    const auto found = functions().find(name);
    *out = found == functions().end() ? nullptr : found->second;
    return *out ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

} // namespace

} // namespace shoal::test

shoal::test::FakeRuntime& shoalFakeRuntime() {
    static shoal::test::FakeRuntime runtime;
    return runtime;
}

// The loader's side, as its specification lays it out; Debian ships no header for it.
namespace {
struct LoaderInfo {
    int type;
    uint32_t version;
    size_t size;
    uint32_t minInterface, maxInterface;
    XrVersion minApi, maxApi;
};
struct RuntimeRequest {
    int type;
    uint32_t version;
    size_t size;
    uint32_t runtimeInterface;
    XrVersion runtimeApi;
    PFN_xrGetInstanceProcAddr getInstanceProcAddr;
};
} // namespace

extern "C" XrResult xrNegotiateLoaderRuntimeInterface(const LoaderInfo* loader, RuntimeRequest* runtime) {
    constexpr int kLoaderInfo = 1, kRuntimeRequest = 3;
    if (loader->type != kLoaderInfo || loader->size != sizeof(LoaderInfo) ||
        runtime->type != kRuntimeRequest || runtime->size != sizeof(RuntimeRequest) ||
        loader->minInterface > 1)
        return XR_ERROR_INITIALIZATION_FAILED;
    runtime->runtimeInterface = 1;
    runtime->runtimeApi = XR_CURRENT_API_VERSION;
    runtime->getInstanceProcAddr =
        reinterpret_cast<PFN_xrGetInstanceProcAddr>(shoal::test::functions().at("xrGetInstanceProcAddr"));
    return XR_SUCCESS;
}
