// Hours of dives one after the other in one process: soak [HOURS [FIRST]]. Dive n has seed n, is played by
// the script tests/playthrough/whole_dive.toml, and every fifth is drawn by the program's own loop. Prints a
// row an hour and exits 1 where memory, open files or threads grow, OpenGL reports an error, or a dive ends
// in another state than the same dive in a process of its own.
#include "engine/core/WriteFile.h"
#include "game/app/Application.h"
#include "tests/TestPaths.h"
#include "tests/TestRig.h"
#include "tests/playthrough/Play.h"

#include <epoxy/gl.h>
#include <nlohmann/json.hpp>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <malloc.h>

using namespace shoal;

namespace {

constexpr int kDivesAnHour = 40, kDrawnEvery = 5, kAloneEvery = 40;
constexpr double kMaxGrowth = 1.01; // of memory, from the second hour to the last

struct Used {
    double memory_MB = 0;
    long files = 0, threads = 0;
};

Used usedNow() {
    Used used;
    ::malloc_trim(0); // counts what is held, and not what the allocator keeps for next time
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    used.memory_MB = static_cast<double>(resident) * 4096 / 1e6;
    const auto entries = [](const char* folder) {
        return std::distance(std::filesystem::directory_iterator(folder), {});
    };
    used.files = entries("/proc/self/fd");
    used.threads = entries("/proc/self/task");
    return used;
}

// The script with another seed, and without what it expects of its own.
Status writeScript(const Path& to, const std::string& text, uint64_t seed) {
    std::string changed = text.substr(0, text.find("[[expect]]"));
    const size_t at = changed.find("seed = "), end = changed.find('\n', at);
    if (at == std::string::npos) return Error{to.string(), "the script names no seed"};
    return writeFileWhole(to, changed.replace(at, end - at, "seed = " + std::to_string(seed)));
}

int openGlErrors = 0;

void countErrors(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void*) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    ++openGlErrors;
    std::fprintf(stderr, "OpenGL: %s\n", message);
}

// Plays by the program's own loop; returns the state that it ends in.
Result<uint64_t> drawn(const Path& script) {
    app::PlayOptions options;
    options.headless = true;
    options.hands.source = "script:" + script.string();
    options.look.size = {64, 36};
    options.fps = 15;
    app::Application application(options);
    if (Status opened = application.open(); !opened) return opened.error();
    if (epoxy_has_gl_extension("GL_KHR_debug")) {
        glEnable(GL_DEBUG_OUTPUT);
        glDebugMessageCallback(countErrors, nullptr);
    }
    if (Status played = application.run(true); !played) return played.error();
    while (glGetError() != GL_NO_ERROR) ++openGlErrors;
    return application.statistics().stateHash;
}

// Plays by the program in a process of its own.
Result<uint64_t> alone(const Path& script, const Path& folder) {
    const Path statistics = folder / "stats.json";
    const std::string command = "'" + tests::program() +
                                "' play --headless --fps 15 --hands script:" + script.string() + " --stats " +
                                statistics.string();
    if (std::system(command.c_str()) != 0) return Error{script.string(), "failed in a process of its own"};
    const auto text = readText(statistics);
    if (!text) return text.error();
    const auto json = nlohmann::json::parse(*text, nullptr, false);
    return std::strtoull(json.value("state_hash", "").c_str(), nullptr, 16);
}

Status playAll(int hours, uint64_t first) {
    const Path whole = tests::sourceFolder() / "tests/playthrough/whole_dive.toml";
    const auto dive = game::loadScriptedDive(whole, true);
    if (!dive) return dive.error();
    const auto text = readText(whole);
    if (!text) return text.error();
    const tests::ScratchFolder folder;
    std::filesystem::copy(tests::sourceFolder() / "tests/playthrough/dive", folder / "dive"); // the script's
    const Path script = folder / "dive.toml";
    Used second, used;
    std::printf("hour  dives  memory, MB  open files  threads  OpenGL errors\n");
    for (int hour = 1; hour <= hours; ++hour) {
        for (int i = 0; i < kDivesAnHour; ++i) {
            const uint64_t seed = first + static_cast<uint64_t>((hour - 1) * kDivesAnHour + i);
            game::Script own = dive->script;
            own.seed = seed;
            const game::Played played = game::playScript(own, tests::rig(), dive->files);
            if (Status written = writeScript(script, *text, seed); !written) return written;
            const auto same = [&](const Result<uint64_t>& hash) -> Status {
                if (!hash) return hash.error();
                if (*hash == played.recording.hash(played.recording.ticks() - 1)) return Done{};
                return Error{"dive " + std::to_string(seed), "ends in another state"};
            };
            if (i % kDrawnEvery == 0)
                if (Status equal = same(drawn(script)); !equal) return equal;
            if (i % kAloneEvery == 0)
                if (Status equal = same(alone(script, folder.path())); !equal) return equal;
        }
        used = usedNow();
        if (hour <= 2) second = used;
        std::printf("%4d  %5d  %10.1f  %10ld  %7ld  %13d\n", hour, hour * kDivesAnHour, used.memory_MB,
                    used.files, used.threads, openGlErrors);
        std::fflush(stdout);
    }
    if (openGlErrors > 0) return Error{"", "OpenGL reported errors"};
    if (used.memory_MB > kMaxGrowth * second.memory_MB) return Error{"", "memory grows"};
    if (used.files > second.files || used.threads > second.threads)
        return Error{"", "open files or threads grow"};
    return Done{};
}

} // namespace

int main(int count, char** arguments) {
    const int hours = count > 1 ? std::max(1, std::atoi(arguments[1])) : 8;
    const int first = count > 2 ? std::max(1, std::atoi(arguments[2])) : 1;
    const Status played = playAll(hours, static_cast<uint64_t>(first));
    if (!played) std::fprintf(stderr, "soak: %s\n", played.error().message().c_str());
    return played ? 0 : 1;
}
