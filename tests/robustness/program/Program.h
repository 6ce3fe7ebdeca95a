// Runs the program as a person would, by a command line in a folder of its own.
#pragma once

#include "engine/core/Files.h"
#include "tests/Test.h"

#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

int shoalMain(int argc, char** argv); // main() of the program

namespace shoal::tests {

struct Outcome {
    int status = -1; // exit status, or minus the signal that ended it
    std::string out; // standard output
    std::string err;
};

class Program : public testing::Test {
  protected:
    ScratchFolder scratch_;
    Path folder_ = scratch_.path();
    std::string environment_; // arguments of env(1) for a run, as NAME=VALUE
    bool isFresh_ = false;    // whether each run is a new process, which finds programs beside its own

    // The program that makes depth tracks, beside the game.
    static std::string depthProgram() { return Path(program()).parent_path() / "shoal-depth"; }

    // Whether this process has no threads but one, so that its copy can go on. Sanitizers look for leaks when
    // a program ends, which a copy does not.
    static bool canBeCopied() {
#ifdef __SANITIZE_ADDRESS__
        return false;
#endif
        return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {}) == 1;
    }

    // Runs the game in a copy of this process, which has its libraries, unless it needs env or the shell.
    Outcome run(const std::string& arguments, const std::string& which = program()) const {
        wordexp_t words{.we_offs = 1};
        if (isFresh_ || which != program() || !environment_.empty() || !canBeCopied() ||
            ::wordexp(arguments.c_str(), &words, WRDE_NOCMD | WRDE_DOOFFS) != 0) {
            // The shell reads the arguments, and its own process becomes the program's.
            const std::string command = "exec env " + environment_ + " '" + which + "' " + arguments;
            return {end(start({"-c", command}, {}, "/bin/sh")), out(), err()};
        }
        std::string name = which;
        words.we_wordv[0] = name.data();
        const int status = end(inFolder([&]() noexcept {
            const int result = shoalMain(static_cast<int>(words.we_wordc) + 1, words.we_wordv);
            std::fflush(nullptr);
            ::_exit(result);
        }));
        ::wordfree(&words);
        return {status, out(), err()};
    }

    // Standard output and error go to files. before: runs in the child.
    pid_t start(std::vector<std::string> words, const std::function<void()>& before = {},
                const std::string& which = program()) const {
        words.insert(words.begin(), which);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        return inFolder([&] {
            if (before) before();
            ::execv(arguments[0], arguments.data());
        });
    }
    template <class Act> pid_t inFolder(Act&& act) const {
        std::fflush(nullptr); // or the child would write it again
        const pid_t child = ::fork();
        if (child != 0) return child;
        for (const char* name : {"XDG_CACHE_HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME"})
            ::setenv(name, folder_.c_str(), 1);
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        if (::chdir(folder_.c_str()) != 0) ::_exit(126);
        const auto opened = [](const char* name) { return ::open(name, O_WRONLY | O_CREAT | O_TRUNC, 0600); };
        ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
        ::dup2(opened("stdout.txt"), STDOUT_FILENO);
        ::dup2(opened("stderr.txt"), STDERR_FILENO);
        ::alarm(1000);
        act();
        ::_exit(127);
    }
    static int end(pid_t child) {
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    // The same for words that no shell reads.
    int statusOf(std::vector<std::string> words, const std::function<void()>& before = {}) const {
        return end(start(std::move(words), before));
    }

    std::string out() const { return textOf("stdout.txt"); }
    std::string err() const { return textOf("stderr.txt"); }
    std::string textOf(const std::string& name) const {
        const auto text = readText(folder_ / name);
        return text ? *text : "";
    }

    // Returns the first value of that name in a file of statistics, text with its quotes; empty: none.
    std::string statisticIn(const std::string& file, const std::string& name) const {
        const std::string text = textOf(file), key = "\"" + name + "\": ";
        const size_t at = text.find(key);
        if (at == std::string::npos) return "";
        const size_t from = at + key.size();
        return text.substr(from, text.find_first_of(",\n", from) - from);
    }

    // Writes a file of the folder, and returns its name.
    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return name;
    }

    static long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

    void expectOneMessage(const Outcome& outcome, const std::string& about, int status = 1) const {
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(about), std::string::npos) << outcome.err;
    }
};

} // namespace shoal::tests
