// A file of its own, because X11's headers define macros such as Status and None.
#include "tests/gl/xr/WindowEvents.h"

#include <GLFW/glfw3.h>
#include <X11/Xlib.h>

#include <memory>
#include <utility>

// Declared as in GLFW/glfw3native.h, which asks for headers of more of X than this needs.
extern "C" Window glfwGetX11Window(GLFWwindow* window);

namespace shoal::test {

namespace {

// Sends an event, which is in the window's queue on return.
void send(XEvent event, long mask) {
    const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(nullptr), &XCloseDisplay);
    event.xany.display = display.get();
    event.xany.window = glfwGetX11Window(glfwGetCurrentContext());
    if (mask == KeyPressMask) {
        event.xkey.root = DefaultRootWindow(display.get());
        event.xkey.keycode = XKeysymToKeycode(display.get(), event.xkey.keycode);
    }
    XSendEvent(display.get(), event.xany.window, True, mask, &event);
    XSync(display.get(), False);
}

std::function<bool()>& eachPoll() {
    static std::function<bool()> then;
    return then;
}

void sendExposure() {
    XEvent event{};
    event.xexpose = {.type = Expose};
    send(event, ExposureMask);
}

} // namespace

void strikeKey(const char* key) {
    for (const int type : {KeyPress, KeyRelease}) {
        XEvent event{};
        event.xkey = {
            .type = type, .keycode = static_cast<unsigned>(XStringToKeysym(key)), .same_screen = True};
        send(event, KeyPressMask);
    }
}

void onEachPoll(std::function<bool()> then) {
    eachPoll() = std::move(then);
    glfwSetWindowRefreshCallback(glfwGetCurrentContext(), [](GLFWwindow*) {
        if (eachPoll() && !eachPoll()()) eachPoll() = nullptr;
        if (eachPoll()) sendExposure();
    });
    sendExposure();
}

} // namespace shoal::test
