// A file of its own, because X11's headers define macros such as Status and None.
#include "tests/gl/xr/WindowEvents.h"

#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/keysym.h>

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

KeySym symbolOf(int glfwKey) {
    switch (glfwKey) {
    case GLFW_KEY_ESCAPE:
        return XK_Escape;
    case GLFW_KEY_ENTER:
        return XK_Return;
    case GLFW_KEY_DOWN:
        return XK_Down;
    case GLFW_KEY_HOME:
        return XK_Home;
    default:
        return static_cast<KeySym>(XK_F1 + (glfwKey - GLFW_KEY_F1));
    }
}

void sendExposure() {
    XEvent event{};
    event.xexpose = {.type = Expose};
    send(event, ExposureMask);
}

} // namespace

void strikeKey(int glfwKey) {
    const KeySym symbol = symbolOf(glfwKey);
    for (const int type : {KeyPress, KeyRelease}) {
        XEvent event{};
        event.xkey = {.type = type, .keycode = static_cast<unsigned>(symbol), .same_screen = True};
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
