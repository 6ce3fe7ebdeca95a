// Definitions of OpenXR's registry (1.1.53) that the header of Debian 12 (1.0.20) lacks; newer headers keep
// their own. Include it after openxr.h.
#pragma once

#include <openxr/openxr.h>

#ifndef XR_EXT_local_floor // extension 427
#define XR_EXT_LOCAL_FLOOR_EXTENSION_NAME "XR_EXT_local_floor"
inline constexpr auto XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT = static_cast<XrReferenceSpaceType>(1000426000);
#endif

#ifndef XR_EXT_user_presence // extension 471
#define XR_EXT_USER_PRESENCE_EXTENSION_NAME "XR_EXT_user_presence"
inline constexpr auto XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT = static_cast<XrStructureType>(1000470000);
inline constexpr auto XR_TYPE_SYSTEM_USER_PRESENCE_PROPERTIES_EXT = static_cast<XrStructureType>(1000470001);
struct XrEventDataUserPresenceChangedEXT {
    XrStructureType type;
    const void* next;
    XrSession session;
    XrBool32 isUserPresent;
};
struct XrSystemUserPresencePropertiesEXT {
    XrStructureType type;
    void* next;
    XrBool32 supportsUserPresence;
};
#endif

#ifndef XR_EXT_hand_tracking_data_source // extension 429
#define XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME "XR_EXT_hand_tracking_data_source"
inline constexpr auto XR_TYPE_HAND_TRACKING_DATA_SOURCE_INFO_EXT = static_cast<XrStructureType>(1000428000);
enum XrHandTrackingDataSourceEXT { XR_HAND_TRACKING_DATA_SOURCE_UNOBSTRUCTED_EXT = 1 };
struct XrHandTrackingDataSourceInfoEXT {
    XrStructureType type;
    const void* next;
    uint32_t requestedDataSourceCount;
    XrHandTrackingDataSourceEXT* requestedDataSources;
};
#endif
