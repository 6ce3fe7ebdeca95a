#include "engine/platform/Window.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace shoal::platform {

// Returns the first display that starts: a graphics card's (device platform), else Mesa's software one.
static EGLDisplay firstDisplay() {
    const auto queryDevices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (queryDevices) queryDevices(16, devices, &count);
    for (EGLint i = 0; i <= count; ++i) {
        EGLDisplay display =
            i < count ? eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)
                      : eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
    }
    return EGL_NO_DISPLAY;
}

Headless::Headless(void* display)
    : display_(display, [](void* opened) {
          eglMakeCurrent(opened, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
          eglTerminate(opened);
      }) {}

Result<Headless> Headless::open() {
    EGLDisplay display = firstDisplay();
    if (display == EGL_NO_DISPLAY)
        return Error{"", "no OpenGL without a display here; install libgl1-mesa-dri and libegl1"};
    Headless opened(display);
    eglBindAPI(EGL_OPENGL_API);
    for (const auto& [major, minor] : kGlVersions) {
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     major,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     minor,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
            return opened;
    }
    return Error{"", "the graphics driver has no OpenGL 3.3 core context to give"};
}

} // namespace shoal::platform
