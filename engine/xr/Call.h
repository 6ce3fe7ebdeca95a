// Calls of OpenXR as results. Only for the sources of this folder.
#pragma once

#include "engine/core/Result.h"

#include <epoxy/gl.h>

#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

// Status of a call; when it fails the error names call and result: "OpenXR: xrCreateSession says
// XR_ERROR_LIMIT_REACHED". Successes with a reservation (XR_SESSION_LOSS_PENDING ...) are successes.
#define SHOAL_XR(call) ::shoal::xr::statusOf((call), #call)

namespace shoal::xr {

Status statusOf(XrResult result, const char* expression);
const char* nameOf(XrResult result);

// A function of an extension, which the loader does not export. Null if there is none.
template <class Function> Function functionOf(XrInstance instance, const char* name) {
    PFN_xrVoidFunction function = nullptr;
    if (XR_FAILED(xrGetInstanceProcAddr(instance, name, &function))) return nullptr;
    return reinterpret_cast<Function>(function);
}

} // namespace shoal::xr
