#include "engine/xr/OpenXr.h"

#include "engine/xr/NewerOpenXr.h"

#include <glm/common.hpp>
#include <openxr/openxr_reflection.h>

#include <cstdlib>
#include <cstring>
#include <string_view>

namespace shoal::xr {

namespace {

template <size_t kSize> std::string textOf(const char (&from)[kSize]) {
    return std::string(from, strnlen(from, kSize));
}

std::vector<XrExtensionProperties> extensions() {
    const auto list = [](uint32_t capacity, uint32_t* count, XrExtensionProperties* items) {
        const XrResult result = xrEnumerateInstanceExtensionProperties(nullptr, capacity, count, items);
        if (result == XR_ERROR_RUNTIME_UNAVAILABLE || result == XR_ERROR_FILE_ACCESS_ERROR ||
            result == XR_ERROR_FILE_CONTENTS_INVALID)
            throw Failure("no headset runtime is active; start one (Monado, SteamVR ...) or let "
                          "XR_RUNTIME_JSON name its file (" +
                          std::string(nameOf(result)) + ")");
        return result;
    };
    return enumerate(XrExtensionProperties{XR_TYPE_EXTENSION_PROPERTIES},
                     "xrEnumerateInstanceExtensionProperties", list);
}

void findHeadset(Instance& instance) {
    Properties& properties = instance.properties;
    const XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    const XrResult found = xrGetSystem(instance.handle.get(), &wanted, &instance.system);
    if (found == XR_ERROR_FORM_FACTOR_UNAVAILABLE || found == XR_ERROR_FORM_FACTOR_UNSUPPORTED)
        throw Failure(instance.runtimeName + " has no headset; plug it in and wake it (xrGetSystem says " +
                      nameOf(found) + ")");
    check(found, "xrGetSystem");

    XrSystemHandTrackingPropertiesEXT hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT};
    XrSystemProperties system{XR_TYPE_SYSTEM_PROPERTIES};
    XrSystemUserPresencePropertiesEXT presence{XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT};
    if (properties.bareHands) system.next = &hands;
    if (instance.sensesWearer) presence.next = std::exchange(system.next, &presence);
    SHOAL_XR(xrGetSystemProperties(instance.handle.get(), instance.system, &system));
    properties.name = textOf(system.systemName) + " (" + instance.runtimeName + ")";
    properties.bareHands &= hands.supportsHandTracking == XR_TRUE;
    instance.sensesWearer &= presence.supportsUserPresence == XR_TRUE;

    const auto views = enumerate(XrViewConfigurationView{XR_TYPE_VIEW_CONFIGURATION_VIEW},
                                 "xrEnumerateViewConfigurationViews", xrEnumerateViewConfigurationViews,
                                 instance.handle.get(), instance.system, kStereo);
    if (views.size() != 2) throw Failure(instance.runtimeName + " shows no two eyes");
    constexpr uint32_t kMax = 8192;
    for (const XrViewConfigurationView& view : views) { // both eyes get the larger size
        const auto side = [&](uint32_t recommended, uint32_t maximum) {
            return static_cast<int>(std::clamp(recommended, 16u, std::clamp(maximum, 16u, kMax)));
        };
        properties.eyeSize = glm::max(
            properties.eyeSize, glm::ivec2(side(view.recommendedImageRectWidth, view.maxImageRectWidth),
                                           side(view.recommendedImageRectHeight, view.maxImageRectHeight)));
    }

    const auto blends =
        enumerate(XR_ENVIRONMENT_BLEND_MODE_OPAQUE, "xrEnumerateEnvironmentBlendModes",
                  xrEnumerateEnvironmentBlendModes, instance.handle.get(), instance.system, kStereo);
    const auto offers = [&](auto mode) { return std::ranges::find(blends, mode) != blends.end(); };
    properties.seesRoom = offers(XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
    // Prefers the opaque mode if the headset offers it, because the film fills the whole picture.
    if (!offers(XR_ENVIRONMENT_BLEND_MODE_OPAQUE) && !blends.empty()) instance.blend = blends.front();
}

} // namespace

const char* nameOf(XrResult result) {
    switch (result) {
#define SHOAL_XR_CASE(name, value)                                                                           \
    case name:                                                                                               \
        return #name;
        XR_LIST_ENUM_XrResult(SHOAL_XR_CASE)
#undef SHOAL_XR_CASE
            default : return "an unknown result";
    }
}

XrResult check(XrResult result, const char* call) {
    if (XR_SUCCEEDED(result)) return result;
    const std::string_view text(call);
    const std::string name(text.substr(0, text.find('(')));
    if (result == XR_ERROR_INSTANCE_LOST || result == XR_ERROR_SESSION_LOST)
        throw Failure("the headset's runtime is gone (" + name + " says " + nameOf(result) + ")", true);
    throw Failure(name + " says " + nameOf(result));
}

Instance Instance::open(bool withHeadset) {
    setenv("XR_LOADER_DEBUG", "none", 0); // errors are reported in our own words; the player's setting stands
    const auto present = extensions();
    Instance instance;
    const auto enable = [&](const char* name) { // returns whether the runtime has it
        const bool has = std::ranges::any_of(present, [&](const XrExtensionProperties& extension) {
            return textOf(extension.extensionName) == name;
        });
        if (has) instance.enabled.push_back(name);
        return has;
    };
    if (withHeadset) {
        if (!enable(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME))
            throw Failure("the active runtime takes no pictures from OpenGL "
                          "(" XR_KHR_OPENGL_ENABLE_EXTENSION_NAME ")");
        instance.properties.bareHands = enable(XR_EXT_HAND_TRACKING_EXTENSION_NAME);
        if (instance.properties.bareHands) enable(XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME);
        instance.sensesWearer = enable(XR_EXT_USER_PRESENCE_EXTENSION_NAME);
        instance.properties.takesDepth = enable(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
        enable(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME);
        enable(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
        for (const char* name : Actions::extensions()) enable(name);
    }
    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    info.applicationInfo = {"Shoal", 1, "Shoal", 1, XR_CURRENT_API_VERSION}; // application and engine
    info.enabledExtensionCount = static_cast<uint32_t>(instance.enabled.size());
    info.enabledExtensionNames = instance.enabled.data();
    XrInstance handle = XR_NULL_HANDLE;
    const XrResult created = xrCreateInstance(&info, &handle);
    // Results of a runtime's library whose service does not answer (Monado: RUNTIME_FAILURE).
    if (created == XR_ERROR_RUNTIME_UNAVAILABLE || created == XR_ERROR_RUNTIME_FAILURE ||
        created == XR_ERROR_INITIALIZATION_FAILED || created == XR_ERROR_INSTANCE_LOST)
        throw Failure("a headset runtime is installed and does not answer; start its service "
                      "(monado-service, SteamVR ...) (xrCreateInstance says " +
                      std::string(nameOf(created)) + ")");
    check(created, "xrCreateInstance");
    instance.handle.reset(handle);
    XrInstanceProperties properties{XR_TYPE_INSTANCE_PROPERTIES};
    SHOAL_XR(xrGetInstanceProperties(handle, &properties));
    instance.runtimeName = textOf(properties.runtimeName);
    if (withHeadset) findHeadset(instance);
    return instance;
}

} // namespace shoal::xr
