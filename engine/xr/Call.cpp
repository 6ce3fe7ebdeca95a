#include "engine/xr/Call.h"

#include <openxr/openxr_reflection.h>

#include <string_view>

namespace shoal::xr {

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

Status statusOf(XrResult result, const char* expression) {
    if (XR_SUCCEEDED(result)) return Done{};
    const std::string_view call(expression);
    const std::string name(call.substr(0, call.find('(')));
    if (result == XR_ERROR_INSTANCE_LOST || result == XR_ERROR_SESSION_LOST)
        return Error{"OpenXR", "the headset's runtime is gone (" + name + " says " + nameOf(result) + ")"};
    return Error{"OpenXR", name + " says " + nameOf(result)};
}

} // namespace shoal::xr
