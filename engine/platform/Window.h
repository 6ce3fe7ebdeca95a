// A window, or an off-screen context, of OpenGL 3.3 core or newer; the player's input since the last poll.
#pragma once

#include "engine/core/Hidden.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <glm/vec2.hpp>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace shoal::platform {

struct WindowOptions {
    std::string title = "Shoal";
    int width = 1280, height = 720; // of the framebuffer, pixels
    bool fullscreen = false;        // on the primary monitor, at its own mode
    bool vsync = true;
};

// The first gamepad that GLFW's database of mappings knows, in the layout of an Xbox controller.
struct Gamepad {
    glm::vec2 leftStick{0}, rightStick{0}; // -1 to 1, +x right, +y up; 0 within the dead zone
    float rightTrigger = 0;                // 0 to 1
    std::array<bool, 15> down{};           // by GLFW_GAMEPAD_BUTTON_*
    std::vector<int> pressed;              // buttons that went down since the last poll
};

// Keys by GLFW's numbers (GLFW_KEY_*), which are ASCII capitals for letters.
struct WindowInput {
    std::vector<int> keysPressed;          // since the last poll
    std::vector<std::string> droppedFiles; // since the last poll
    Gamepad gamepad;
    glm::dvec2 cursor{0.5};    // 0 to 1 from the window's upper left
    glm::dvec2 cursorMoved{0}; // since the last poll, pixels
    double wheel = 0;          // notches since the last poll, away from the player positive
    bool leftButton = false, rightButton = false;
    bool leftPressed = false, middlePressed = false; // went down since the last poll
    bool focused = true;
    bool minimised = false;
    bool closing = false;
};

class Window {
  public:
    // Opens a window and makes its context current. Main thread only. Fails if there is no display.
    static Result<Window> open(const WindowOptions& options);

    const WindowInput& poll(); // valid until the next poll
    // Sleeps until the player does something, at most atMost_s; the next poll() returns it.
    void wait(double atMost_s);
    bool down(int key) const;
    glm::ivec2 framebufferSize() const;
    void present();
    void setTitle(const std::string& title);
    void setIcon(const ImageRgba8& icon);
    void setVsync(bool on); // whether present() waits for the monitor
    void toggleFullscreen();
    void holdCursor(bool hold); // hides it and lets it move without bounds
    double refreshRate_Hz() const;
    GLFWwindow* handle() const;

  private:
    struct State;
    explicit Window(Hidden<State> state) : state_(std::move(state)) {}
    Hidden<State> state_;
};

// Versions of OpenGL that are requested, best first. Some drivers (NVIDIA's) give exactly the requested
// version: if only 3.3 were requested, layers, which need 4.3, would never be available.
inline constexpr std::pair<int, int> kGlVersions[] = {{4, 3}, {3, 3}};

// An OpenGL context without display, window or display server: EGL's surfaceless platform.
class Headless {
  public:
    // Makes the context current on the calling thread. OpenGL 3.3 core or newer.
    static Result<Headless> open();

  private:
    explicit Headless(void* display);
    std::unique_ptr<void, void (*)(void*)> display_; // EGL's display; destroying it destroys the context
};

} // namespace shoal::platform
