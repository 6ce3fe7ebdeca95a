// An X server without a screen, for what needs GLX.
#pragma once

#include <cstdlib>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace shoal::test {

class VirtualDisplay {
  public:
    // Runs Xvfb on a display that is free, and lets DISPLAY name it.
    VirtualDisplay() {
        int ready[2];
        if (pipe(ready) != 0) return;
        child_ = fork();
        if (child_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGTERM); // does not outlive the test, however that ends
            const std::string number = std::to_string(ready[1]);
            close(ready[0]);
            if (!freopen("/dev/null", "w", stderr)) _exit(126);
            // Without -noreset it starts over once its last client is gone, and whoever connects in that
            // moment is turned away: a test that opens one window after another would fail now and then.
            execlp("Xvfb", "Xvfb", "-noreset", "-displayfd", number.c_str(), "-screen", "0", "1024x768x24",
                   "-nolisten", "tcp", static_cast<char*>(nullptr));
            _exit(127);
        }
        close(ready[1]);
        std::string number; // written once the server takes connections
        for (char c = 0; read(ready[0], &c, 1) == 1 && c != '\n';) number += c;
        close(ready[0]);
        runs_ = !number.empty();
        if (!runs_) return;
        setenv("DISPLAY", (":" + number).c_str(), 1);
        unsetenv("WAYLAND_DISPLAY");
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    ~VirtualDisplay() {
        if (child_ <= 0) return;
        kill(child_, SIGTERM);
        waitpid(child_, nullptr, 0);
    }
    explicit operator bool() const { return runs_; } // false: there is no Xvfb

  private:
    pid_t child_ = -1;
    bool runs_ = false;
};

} // namespace shoal::test
