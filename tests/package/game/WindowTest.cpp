// The program in a window, as a desktop starts and ends it. A server without a screen shows it.
#include "engine/core/Files.h"
#include "tests/TestPaths.h"
#include "tests/gl/xr/VirtualDisplay.h"

#include <gtest/gtest.h>

#include <X11/Xlib.h>
#include <X11/keysym.h>

#include <memory>
#include <spawn.h>
#include <string>
#include <vector>

namespace shoal {
namespace {

// Watches for windows on the display that DISPLAY names.
class Desktop {
  public:
    Desktop() : display_(XOpenDisplay(nullptr), &XCloseDisplay) {
        XSelectInput(display_.get(), DefaultRootWindow(display_.get()), SubstructureNotifyMask);
    }

    // Waits until a window is shown.
    Window nextWindow() const {
        for (XEvent event;;) {
            XNextEvent(display_.get(), &event);
            if (event.type == MapNotify && !event.xmap.override_redirect) return event.xmap.window;
        }
    }
    std::string title(Window window) const {
        char* name = nullptr;
        XFetchName(display_.get(), window, &name);
        const std::string text = name ? name : "";
        XFree(name);
        return text;
    }
    // Press and release come together, so that the program sees both in one frame.
    void strike(Window window, KeySym key) const {
        for (const int type : {KeyPress, KeyRelease}) {
            XEvent event{};
            event.xkey = {.type = type,
                          .display = display_.get(),
                          .window = window,
                          .root = DefaultRootWindow(display_.get()),
                          .same_screen = True};
            event.xkey.keycode = XKeysymToKeycode(display_.get(), key);
            XSendEvent(display_.get(), window, True, KeyPressMask, &event);
        }
        XFlush(display_.get());
    }
    // Closes it as the button of its frame does.
    void close(Window window) const {
        XEvent event{};
        event.xclient = {.type = ClientMessage,
                         .window = window,
                         .message_type = XInternAtom(display_.get(), "WM_PROTOCOLS", False),
                         .format = 32};
        event.xclient.data.l[0] = static_cast<long>(XInternAtom(display_.get(), "WM_DELETE_WINDOW", False));
        XSendEvent(display_.get(), window, False, NoEventMask, &event);
        XFlush(display_.get());
    }

  private:
    std::unique_ptr<Display, int (*)(Display*)> display_;
};

class InWindow : public testing::Test {
  protected:
    void SetUp() override {
        if (!display_) GTEST_SKIP() << "needs Xvfb";
        setenv("XDG_CONFIG_HOME", scratch_.path().c_str(), 1);
        setenv("XDG_DATA_HOME", scratch_.path().c_str(), 1);
    }
    static pid_t start(std::vector<std::string> words) {
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        pid_t child = 0;
        EXPECT_EQ(posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ), 0);
        return child;
    }
    static int exitStatus(pid_t child) {
        int status = 0;
        EXPECT_EQ(waitpid(child, &status, 0), child);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    tests::ScratchFolder scratch_;
    test::VirtualDisplay display_;
};

// Starts it as `Exec` of the desktop entry does.
TEST_F(InWindow, TheGameOpensAndCloses) {
    const Desktop desktop;
    const pid_t game = start({tests::program(), "play"});
    const Window window = desktop.nextWindow();
    EXPECT_EQ(desktop.title(window), "Shoal");
    desktop.close(window);
    EXPECT_EQ(exitStatus(game), 0);
}

TEST_F(InWindow, ViewSeesAnEscapeThatIsReleasedAtOnce) {
    const Desktop desktop;
    const Path source = tests::sourceFolder();
    const pid_t view = start({tests::program(), "view", (source / "content/models/boxfish.glb").string(),
                              "--env", (source / "content/truth/reef_0120.hdr").string(), "--size", "64x64"});
    desktop.strike(desktop.nextWindow(), XK_Escape);
    EXPECT_EQ(exitStatus(view), 0);
}

} // namespace
} // namespace shoal
