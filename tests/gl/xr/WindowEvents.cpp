// A file of its own, because X11's headers define macros such as Status and None.
#include "tests/gl/xr/WindowEvents.h"

#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/keysym.h>

#include <map>
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

const std::map<int, KeySym> kSymbols = {{GLFW_KEY_ESCAPE, XK_Escape},
                                        {GLFW_KEY_ENTER, XK_Return},
                                        {GLFW_KEY_DOWN, XK_Down},
                                        {GLFW_KEY_HOME, XK_Home},
                                        {GLFW_KEY_F2, XK_F2}};

void sendExposure() {
    XEvent event{};
    event.xexpose = {.type = Expose};
    send(event, ExposureMask);
}

} // namespace

void strikeKey(int glfwKey) {
    for (const int type : {KeyPress, KeyRelease}) {
        XEvent event{};
        event.xkey = {
            .type = type, .keycode = static_cast<unsigned>(kSymbols.at(glfwKey)), .same_screen = True};
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
