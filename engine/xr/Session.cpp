// Creation of the session in the current OpenGL context. It has a file of its own, because X11's headers
// define macros such as Status and None.
#include "engine/core/Result.h"

#include <epoxy/gl.h>
#include <fmt/core.h>
// Included last, because it defines macros that would replace words in the headers above.
#include <epoxy/glx.h>

#define XR_USE_PLATFORM_XLIB
#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
#undef Status
#undef None

#include "engine/xr/OpenXr.h"

namespace shoal::xr {

// The extension demands that the requirements are queried before a session is made.
static void checkRequirements(const Instance& instance) {
    const auto get = functionOf<PFN_xrGetOpenGLGraphicsRequirementsKHR>(instance.handle.get(),
                                                                        "xrGetOpenGLGraphicsRequirementsKHR");
    if (!get) throw Failure("the runtime lacks xrGetOpenGLGraphicsRequirementsKHR");
    XrGraphicsRequirementsOpenGLKHR wanted{XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR};
    check(get(instance.handle.get(), instance.system, &wanted), "xrGetOpenGLGraphicsRequirementsKHR");
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    const XrVersion minimum = wanted.minApiVersionSupported;
    if (minimum > XR_MAKE_VERSION(major, minor, 0xffff))
        throw Failure(fmt::format("{} wants OpenGL {}.{}, the graphics driver gives {}.{}",
                                  instance.runtimeName, XR_VERSION_MAJOR(minimum), XR_VERSION_MINOR(minimum),
                                  major, minor));
}

SessionHandle createSession(const Instance& instance) {
    checkRequirements(instance);
    Display* display = glXGetCurrentDisplay();
    if (!display) throw Failure("the window is none of X11's; run under X11 or Xwayland");
    XrGraphicsBindingOpenGLXlibKHR binding{XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR};
    binding.xDisplay = display;
    binding.glxDrawable = glXGetCurrentDrawable();
    binding.glxContext = glXGetCurrentContext();
    int id = 0, screen = 0, count = 0;
    glXQueryContext(display, binding.glxContext, GLX_FBCONFIG_ID, &id);
    glXQueryContext(display, binding.glxContext, GLX_SCREEN, &screen);
    const int wanted[] = {GLX_FBCONFIG_ID, id, 0};
    if (GLXFBConfig* configs = glXChooseFBConfig(display, screen, wanted, &count)) {
        if (count > 0) binding.glxFBConfig = configs[0];
        XFree(configs);
    }
    if (binding.glxFBConfig)
        if (XVisualInfo* visual = glXGetVisualFromFBConfig(display, binding.glxFBConfig)) {
            binding.visualid = static_cast<uint32_t>(visual->visualid);
            XFree(visual);
        }
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, instance.system};
    return SessionHandle(
        written(XrSession{}, "xrCreateSession", xrCreateSession, instance.handle.get(), &info));
}

} // namespace shoal::xr
