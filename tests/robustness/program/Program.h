// The program, run as a person would: words on a command line, what it says and how it ends.
#pragma once

#include "engine/core/Files.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <sys/wait.h>

namespace shoal::tests {

struct Outcome {
    int status = -1; // exit status; -1 if a signal ended it
    std::string out; // standard output
    std::string err;
};

class Program : public testing::Test {
  protected:
    ScratchFolder scratch_;
    Path folder_ = scratch_.path();

    // The program that makes depth tracks, beside the game.
    static std::string depthProgram() { return Path(program()).parent_path() / "shoal-depth"; }

    Outcome run(const std::string& arguments, const std::string& which = program()) const {
        const Path out = folder_ / "stdout.txt", err = folder_ / "stderr.txt";
        const std::string command = "env -u DISPLAY -u WAYLAND_DISPLAY XDG_CACHE_HOME=" + folder_.string() +
                                    " XDG_DATA_HOME=" + folder_.string() +
                                    " XDG_CONFIG_HOME=" + folder_.string() + " timeout 1000 '" + which +
                                    "' " + arguments + " >" + out.string() + " 2>" + err.string() +
                                    " </dev/null";
        const int status = std::system(command.c_str());
        const auto text = [](const Path& file) {
            auto content = readText(file);
            return content ? *content : std::string();
        };
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
    }

    Path write(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    static long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

    void expectOneMessage(const Outcome& outcome, const std::string& about, int status = 1) const {
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(about), std::string::npos) << outcome.err;
    }
};

} // namespace shoal::tests
