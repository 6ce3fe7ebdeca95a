// Apart from the rest, because X11's headers define words such as Status and None.
#include "tests/gl/xr/Keyboard.h"

#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/keysym.h>

#include <memory>

// As GLFW/glfw3native.h declares it, which asks for headers of more of X than this needs.
extern "C" Window glfwGetX11Window(GLFWwindow* window);

namespace shoal::test {

void strikeFunctionKey(int glfwKey) {
    const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(nullptr), &XCloseDisplay);
    const Window window = glfwGetX11Window(glfwGetCurrentContext());
    for (const int type : {KeyPress, KeyRelease}) {
        XEvent event{};
        event.xkey = {.type = type,
                      .display = display.get(),
                      .window = window,
                      .root = DefaultRootWindow(display.get()),
                      .same_screen = True};
        event.xkey.keycode =
            XKeysymToKeycode(display.get(), static_cast<KeySym>(XK_F1 + (glfwKey - GLFW_KEY_F1)));
        XSendEvent(display.get(), window, True, KeyPressMask, &event);
    }
    XSync(display.get(), False); // it is in the window's queue now
}

} // namespace shoal::test
