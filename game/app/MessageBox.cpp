#include "game/app/MessageBox.h"

#include <cstdlib>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace shoal::app {

namespace {

bool run(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    if (::posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return false;
    int status = 0;
    return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) != 127;
}

// Doubles backslashes: zenity and kdialog take a backslash and the next character for one.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '\\' ? "\\\\" : std::string(1, c);
    return out;
}

} // namespace

bool startedFromMenu() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::isatty(stream)) return false;
    for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY"})
        if (const char* set = std::getenv(display); set && *set) return true;
    return false;
}

bool showMessageBox(const std::string& text) {
    return run({"zenity", "--error", "--no-markup", "--title=Shoal", "--text=" + escaped(text)}) ||
           run({"kdialog", "--title", "Shoal", "--error", escaped(text)}) ||
           run({"xmessage", "-center", "-title", "Shoal", text});
}

} // namespace shoal::app
