#include "engine/gl/Renderer.h"

#include <epoxy/gl.h>

#include <filesystem>
#include <fstream>
#include <sched.h>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::gl {

bool rendersInSoftware() {
    const std::string_view name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const std::string_view part : {"llvmpipe", "softpipe", "SwiftShader"})
        if (name.find(part) != std::string_view::npos) return true;
    return false;
}

void spreadRasterThreads() {
    std::vector<pid_t> threads;
    std::error_code gone;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", gone)) {
        std::ifstream name(task.path() / "comm");
        std::string text;
        if (std::getline(name, text) && text.starts_with("llvmpipe-"))
            threads.push_back(std::stoi(task.path().filename().string()));
    }
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0 ||
        static_cast<size_t>(CPU_COUNT(&allowed)) != threads.size())
        return;
    int core = 0;
    for (const pid_t thread : threads) {
        while (!CPU_ISSET(core, &allowed)) ++core;
        cpu_set_t own;
        CPU_ZERO(&own);
        CPU_SET(core++, &own);
        sched_setaffinity(thread, sizeof own, &own);
    }
}

} // namespace shoal::gl
