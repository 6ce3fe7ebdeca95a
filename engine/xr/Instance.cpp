#include "engine/xr/Instance.h"

#include <glm/common.hpp>

#include <cstdlib>
#include <cstring>
#include <span>

namespace shoal::xr {

namespace {

constexpr auto kViews = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

template <size_t kSize> void copyText(char (&to)[kSize], const char* from) {
    std::strncpy(to, from, kSize - 1);
}

template <size_t kSize> std::string textOf(const char (&from)[kSize]) {
    return std::string(from, strnlen(from, kSize));
}

Result<std::vector<XrExtensionProperties>> extensions() {
    return enumerate(XrExtensionProperties{XR_TYPE_EXTENSION_PROPERTIES},
                     [](uint32_t capacity, uint32_t* count, XrExtensionProperties* items) -> Status {
                         const XrResult result =
                             xrEnumerateInstanceExtensionProperties(nullptr, capacity, count, items);
                         if (result == XR_ERROR_RUNTIME_UNAVAILABLE || result == XR_ERROR_FILE_ACCESS_ERROR ||
                             result == XR_ERROR_FILE_CONTENTS_INVALID)
                             return Error{"OpenXR", "no headset runtime is active; start one (Monado, "
                                                    "SteamVR ...) or let XR_RUNTIME_JSON name its file (" +
                                                        std::string(nameOf(result)) + ")"};
                         return statusOf(result, "xrEnumerateInstanceExtensionProperties");
                     });
}

Status findHeadset(Instance& instance) {
    const XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    const XrResult found = xrGetSystem(instance.handle.name(), &wanted, &instance.system);
    if (found == XR_ERROR_FORM_FACTOR_UNAVAILABLE || found == XR_ERROR_FORM_FACTOR_UNSUPPORTED)
        return Error{"OpenXR", instance.runtimeName +
                                   " has no headset; plug it in and wake it (xrGetSystem says " +
                                   nameOf(found) + ")"};
    if (Status status = statusOf(found, "xrGetSystem"); !status) return status;

    XrSystemHandTrackingPropertiesEXT hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT};
    XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES};
    if (instance.bareHands) properties.next = &hands;
    if (Status s = SHOAL_XR(xrGetSystemProperties(instance.handle.name(), instance.system, &properties)); !s)
        return s;
    instance.systemName = textOf(properties.systemName);
    instance.bareHands &= hands.supportsHandTracking == XR_TRUE;
    instance.tracksPosition = properties.trackingProperties.positionTracking == XR_TRUE;

    const auto views =
        enumerate(XrViewConfigurationView{XR_TYPE_VIEW_CONFIGURATION_VIEW},
                  [&](uint32_t capacity, uint32_t* count, XrViewConfigurationView* items) {
                      return SHOAL_XR(xrEnumerateViewConfigurationViews(
                          instance.handle.name(), instance.system, kViews, capacity, count, items));
                  });
    if (!views) return views.error();
    if (views->size() != 2) return Error{"OpenXR", instance.runtimeName + " shows no two eyes"};
    constexpr uint32_t kMost = 8192;
    for (const XrViewConfigurationView& view : *views) { // both eyes get the larger size
        const auto side = [&](uint32_t recommended, uint32_t most) {
            return static_cast<int>(std::clamp(recommended, 16u, std::clamp(most, 16u, kMost)));
        };
        instance.eyeSize = glm::max(
            instance.eyeSize, glm::ivec2(side(view.recommendedImageRectWidth, view.maxImageRectWidth),
                                         side(view.recommendedImageRectHeight, view.maxImageRectHeight)));
    }

    const auto blends = enumerate(XR_ENVIRONMENT_BLEND_MODE_OPAQUE, [&](uint32_t capacity, uint32_t* count,
                                                                        XrEnvironmentBlendMode* items) {
        return SHOAL_XR(xrEnumerateEnvironmentBlendModes(instance.handle.name(), instance.system, kViews,
                                                         capacity, count, items));
    });
    if (!blends) return blends.error();
    // The surround is everywhere, so opaque wherever the headset can be.
    const bool opaque =
        std::find(blends->begin(), blends->end(), XR_ENVIRONMENT_BLEND_MODE_OPAQUE) != blends->end();
    if (!opaque && !blends->empty()) instance.blend = blends->front();
    return Done{};
}

} // namespace

Result<Instance> Instance::open(bool withHeadset) {
    setenv("XR_LOADER_DEBUG", "none", 0); // what fails is said in our own words; the player's setting stands
    const auto present = extensions();
    if (!present) return present.error();
    const auto has = [&](const char* name) {
        return std::any_of(present->begin(), present->end(), [&](const XrExtensionProperties& extension) {
            return textOf(extension.extensionName) == name;
        });
    };
    Instance instance;
    std::vector<const char*> wanted;
    if (withHeadset) {
        if (!has(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME))
            return Error{"OpenXR", "the active runtime takes no pictures from OpenGL (" +
                                       std::string(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME) + ")"};
        wanted.push_back(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME);
        instance.bareHands = has(XR_EXT_HAND_TRACKING_EXTENSION_NAME);
        instance.hiddenPixels = has(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME);
        if (instance.bareHands) wanted.push_back(XR_EXT_HAND_TRACKING_EXTENSION_NAME);
        if (instance.hiddenPixels) wanted.push_back(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME);
    }
    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    copyText(info.applicationInfo.applicationName, "Shoal");
    info.applicationInfo.applicationVersion = 1;
    copyText(info.applicationInfo.engineName, "Shoal");
    info.applicationInfo.engineVersion = 1;
    info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
    info.enabledExtensionCount = static_cast<uint32_t>(wanted.size());
    info.enabledExtensionNames = wanted.data();
    if (Status s = SHOAL_XR(xrCreateInstance(&info, instance.handle.fresh())); !s) return s.error();
    XrInstanceProperties properties{XR_TYPE_INSTANCE_PROPERTIES};
    if (Status s = SHOAL_XR(xrGetInstanceProperties(instance.handle.name(), &properties)); !s)
        return s.error();
    instance.runtimeName = textOf(properties.runtimeName);
    if (withHeadset)
        if (Status found = findHeadset(instance); !found) return found.error();
    return instance;
}

} // namespace shoal::xr
