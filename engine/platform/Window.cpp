#include "engine/platform/Window.h"

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

namespace shoal::platform {

static glm::vec2 withDeadZone(float x, float y) {
    constexpr float kDead = 0.18f; // share of the stick's range: sticks do not return to their exact middle
    const glm::vec2 stick(x, -y);
    const float length = glm::length(stick);
    return length <= kDead ? glm::vec2(0) : stick / length * std::min((length - kDead) / (1 - kDead), 1.0f);
}

static void pollGamepad(Gamepad& pad) {
    pad.pressed.clear();
    GLFWgamepadstate state;
    for (int i = GLFW_JOYSTICK_1; i <= GLFW_JOYSTICK_LAST; ++i) {
        if (!glfwJoystickIsGamepad(i) || !glfwGetGamepadState(i, &state)) continue;
        pad.leftStick =
            withDeadZone(state.axes[GLFW_GAMEPAD_AXIS_LEFT_X], state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]);
        pad.rightStick =
            withDeadZone(state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X], state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]);
        pad.rightTrigger = 0.5f + 0.5f * state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER];
        for (size_t button = 0; button < pad.down.size(); ++button) {
            const bool down = state.buttons[button] == GLFW_PRESS;
            if (down && !pad.down[button]) pad.pressed.push_back(static_cast<int>(button));
            pad.down[button] = down;
        }
        return;
    }
    pad = {};
}

static WindowInput& inputOf(GLFWwindow* window) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

struct Window::State {
    GLFWwindow* window = nullptr;
    WindowInput input;
    std::optional<glm::dvec2> lastCursor; // at the last poll; empty: unknown
    bool waited = false;                  // wait() has collected events for the next poll
    glm::ivec2 restorePlace{80}, restoreSize{0};

    void forgetEvents() {
        input.keysPressed.clear();
        input.droppedFiles.clear();
        input.wheel = 0;
        input.leftPressed = input.middlePressed = false;
    }
    ~State() { glfwTerminate(); } // destroys the window too
};

Result<Window> Window::open(const WindowOptions& options) {
    glfwSetErrorCallback([](int, const char*) {}); // errors are reported in our own words below
#ifdef GLFW_PLATFORM_X11 // GLFW 3.4 would use Wayland, to which headsets cannot be bound
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (!glfwInit())
        return Error{"",
                     "there is no display to open a window on; to see something without one, add --headless "
                     "--at 5 --screenshot shoal.png"};
    auto state = makeHidden<State>();
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 24);
    GLFWmonitor* monitor = options.fullscreen ? glfwGetPrimaryMonitor() : nullptr;
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    const int width = mode ? mode->width : options.width, height = mode ? mode->height : options.height;
    state->restoreSize = {options.width, options.height};
    for (const auto& [major, minor] : kGlVersions) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
        state->window = glfwCreateWindow(width, height, options.title.c_str(), monitor, nullptr);
        if (state->window) break;
    }
    if (!state->window)
        return Error{"", "no window with OpenGL 3.3 could be opened; is the graphics driver installed?"};
    glfwMakeContextCurrent(state->window);
    glfwSwapInterval(options.vsync ? 1 : 0);
    glfwSetWindowUserPointer(state->window, &state->input);
    glfwSetKeyCallback(state->window, [](GLFWwindow* window, int key, int, int action, int) {
        if (action == GLFW_PRESS) inputOf(window).keysPressed.push_back(key);
    });
    glfwSetScrollCallback(state->window,
                          [](GLFWwindow* window, double, double y) { inputOf(window).wheel += y; });
    glfwSetMouseButtonCallback(state->window, [](GLFWwindow* window, int button, int action, int) {
        if (action != GLFW_PRESS) return;
        if (button == GLFW_MOUSE_BUTTON_LEFT) inputOf(window).leftPressed = true;
        if (button == GLFW_MOUSE_BUTTON_MIDDLE) inputOf(window).middlePressed = true;
    });
    glfwSetDropCallback(state->window, [](GLFWwindow* window, int count, const char** files) {
        auto& dropped = inputOf(window).droppedFiles;
        dropped.insert(dropped.end(), files, files + count);
    });
    return Window(std::move(state));
}

void Window::wait(double atMost_s) {
    state_->forgetEvents();
    glfwWaitEventsTimeout(atMost_s);
    state_->waited = true;
}

const WindowInput& Window::poll() {
    WindowInput& input = state_->input;
    if (!state_->waited) state_->forgetEvents();
    state_->waited = false;
    glfwPollEvents();
    pollGamepad(input.gamepad);
    GLFWwindow* window = state_->window;
    int width = 1, height = 1;
    glfwGetWindowSize(window, &width, &height);
    glm::dvec2 cursor;
    glfwGetCursorPos(window, &cursor.x, &cursor.y);
    input.cursorMoved = cursor - state_->lastCursor.value_or(cursor);
    state_->lastCursor = cursor;
    if (glfwGetInputMode(window, GLFW_CURSOR) != GLFW_CURSOR_DISABLED)
        input.cursor = {std::clamp(cursor.x / std::max(width, 1), 0.0, 1.0),
                        std::clamp(cursor.y / std::max(height, 1), 0.0, 1.0)};
    input.leftButton = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    input.rightButton = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
    input.focused = glfwGetWindowAttrib(window, GLFW_FOCUSED) == GLFW_TRUE;
    input.minimised = glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE;
    input.closing = glfwWindowShouldClose(window);
    return input;
}

bool Window::down(int key) const { return glfwGetKey(state_->window, key) == GLFW_PRESS; }

glm::ivec2 Window::framebufferSize() const {
    glm::ivec2 size;
    glfwGetFramebufferSize(state_->window, &size.x, &size.y);
    return size;
}

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(handle(), title.c_str()); }

void Window::setIcon(const ImageRgba8& icon) {
    std::vector<uint8_t> pixels = icon.pixels; // GLFW takes no constant pixels
    const GLFWimage image{icon.width, icon.height, pixels.data()};
    glfwSetWindowIcon(handle(), 1, &image);
}

void Window::present() { glfwSwapBuffers(state_->window); }

void Window::setVsync(bool on) { glfwSwapInterval(on ? 1 : 0); }

void Window::toggleFullscreen() {
    GLFWwindow* window = state_->window;
    if (glfwGetWindowMonitor(window))
        return glfwSetWindowMonitor(window, nullptr, state_->restorePlace.x, state_->restorePlace.y,
                                    state_->restoreSize.x, state_->restoreSize.y, GLFW_DONT_CARE);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor) return;
    glfwGetWindowPos(window, &state_->restorePlace.x, &state_->restorePlace.y);
    glfwGetWindowSize(window, &state_->restoreSize.x, &state_->restoreSize.y);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::holdCursor(bool hold) {
    const int mode = hold ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL;
    if (glfwGetInputMode(state_->window, GLFW_CURSOR) == mode) return;
    glfwSetInputMode(state_->window, GLFW_CURSOR, mode);
    state_->lastCursor.reset();
}

double Window::refreshRate_Hz() const {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    return mode && mode->refreshRate > 0 ? mode->refreshRate : 60.0;
}

GLFWwindow* Window::handle() const { return state_->window; }

} // namespace shoal::platform
