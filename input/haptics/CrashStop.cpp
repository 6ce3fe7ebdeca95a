#include "input/haptics/CrashStop.h"

#include <fmt/core.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shoal::haptics {

// The shell waits for a line from a pipe. The destructor sends one; if the process dies, the pipe closes
// without a line. Signals that end the program may also reach the shell, so it ignores them.
CrashStop::CrashStop(const std::string& file, std::span<const uint8_t> stop) {
    constexpr const char* kScript =
        R"(trap '' HUP INT QUIT TERM; read -r line || printf "$1" 2>/dev/null >"$0")";
    std::string octal;
    for (const uint8_t byte : stop) octal += fmt::format("\\{:03o}", byte);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    const char* arguments[] = {"sh", "-c", kScript, file.c_str(), octal.c_str(), nullptr};
    if (posix_spawn(&shell_, "/bin/sh", &actions, nullptr, const_cast<char**>(arguments), environ) != 0)
        shell_ = -1;
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    pipe_ = ends[1];
}

CrashStop::~CrashStop() {
    if (shell_ > 0 && write(pipe_, "\n", 1) == 1) waitpid(shell_, nullptr, 0);
    if (pipe_ >= 0) close(pipe_);
}

} // namespace shoal::haptics
