// Dying by a signal: what the handler still writes. The devices are files here; umockdev.dies_by_* does the
// same with hidapi's.
#include "input/haptics/CrashStop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace shoal::haptics {
namespace {

const std::array<uint8_t, 4> kStop = {5, 1, 0, 7};

struct Outcome {
    int signal = 0;
    std::string written;
};

// What is left of a process that guards a file and then does this.
template <class Do> Outcome after(Do&& act) {
    const std::string file = testing::TempDir() + "crash_" + std::to_string(getpid());
    std::ofstream(file).close();
    const pid_t child = fork();
    if (child == 0) {
        const rlimit none{0, 0};
        setrlimit(RLIMIT_CORE, &none);
        for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, SIG_DFL);
        crash::install();
        const int guard = crash::guard(file, kStop);
        act(guard);
        _exit(0);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    std::ifstream in(file, std::ios::binary);
    Outcome outcome{WIFSIGNALED(status) ? WTERMSIG(status) : 0, {std::istreambuf_iterator<char>(in), {}}};
    std::remove(file.c_str());
    return outcome;
}

const std::string kWritten(kStop.begin(), kStop.end());

TEST(CrashStop, EverySignalThatEndsAProgramStopsTheMotorsAndStillEndsIt) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGTERM, SIGINT, SIGHUP, SIGQUIT}) {
        const Outcome outcome = after([signal](int) { raise(signal); });
        EXPECT_EQ(outcome.signal, signal);
        EXPECT_EQ(outcome.written, kWritten) << signal;
    }
    const Outcome aborted = after([](int) { std::abort(); });
    EXPECT_EQ(aborted.signal, SIGABRT);
    EXPECT_EQ(aborted.written, kWritten);
}

TEST(CrashStop, ARealFaultIsCaught) {
    const Outcome outcome = after([](int) {
        volatile int* nowhere = nullptr;
        // The sanitizers would report this one themselves.
        asm volatile("" : "+r"(nowhere));
#if defined(__SANITIZE_ADDRESS__)
        raise(SIGSEGV);
#else
        *nowhere = 1;
#endif
    });
    EXPECT_EQ(outcome.signal, SIGSEGV);
    EXPECT_EQ(outcome.written, kWritten);
}

TEST(CrashStop, IgnoredSignalsStayIgnored) {
    const Outcome outcome = after([](int) {});
    EXPECT_EQ(outcome.signal, 0);
    EXPECT_EQ(outcome.written, "");
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGHUP, SIG_IGN); // as under nohup
        crash::install();
        raise(SIGHUP);
        _exit(3);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3);
}

TEST(CrashStop, WhatWasLetGoIsLeftAlone) {
    const Outcome outcome = after([](int guard) {
        crash::unguard(guard);
        raise(SIGTERM);
    });
    EXPECT_EQ(outcome.signal, SIGTERM);
    EXPECT_EQ(outcome.written, "");
}

// One thread writes as fast as it can while another dies: the stop is the last thing in the pipe.
TEST(CrashStop, NothingIsWrittenAfterTheStop) {
    const std::string pipe = testing::TempDir() + "crash_pipe_" + std::to_string(getpid());
    std::remove(pipe.c_str());
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reading = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    for (int round = 0; round < 20; ++round) {
        const pid_t child = fork();
        if (child == 0) {
            crash::install();
            crash::guard(pipe, kStop);
            const int writing = open(pipe.c_str(), O_WRONLY);
            std::atomic<int> written = 0;
            std::thread([&] {
                while (true) {
                    const crash::Writing turn;
                    if (turn.allowed() && written < 30000) // below what the pipe takes without being read
                        if (write(writing, "x", 1) == 1) ++written, written.notify_all();
                }
            }).detach();
            written.wait(0);
            raise(SIGTERM);
            _exit(1);
        }
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status));
        std::string all(65536, 0);
        const ssize_t size = read(reading, all.data(), all.size());
        ASSERT_GE(size, 5);
        EXPECT_EQ(all.substr(static_cast<size_t>(size) - 4, 4), kWritten);
    }
    close(reading);
    std::remove(pipe.c_str());
}

// A device that takes its time with a report while the program dies: that report first, then the stop.
TEST(CrashStop, AWritingInWorkIsWaitedFor) {
    const std::string pipe = testing::TempDir() + "crash_slow_pipe_" + std::to_string(getpid());
    std::remove(pipe.c_str());
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reading = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    const pid_t child = fork();
    if (child == 0) {
        crash::install();
        crash::guard(pipe, kStop);
        const int writing = open(pipe.c_str(), O_WRONLY);
        std::atomic<bool> begun = false;
        std::thread([&] {
            const crash::Writing turn;
            begun = true;
            begun.notify_all();
            poll(nullptr, 0, 5);
            if (write(writing, "x", 1) != 1) _exit(1);
        }).detach();
        begun.wait(false);
        raise(SIGTERM);
        _exit(1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    std::string all(64, 0);
    const ssize_t size = read(reading, all.data(), all.size());
    ASSERT_EQ(size, 5);
    EXPECT_EQ(all.substr(0, 5), "x" + kWritten);
    close(reading);
    std::remove(pipe.c_str());
}

TEST(CrashStop, AThreadThatDiesWhileItWritesDoesNotWaitForItself) {
    const Outcome outcome = after([](int) {
        const crash::Writing writing;
        raise(SIGABRT);
    });
    EXPECT_EQ(outcome.signal, SIGABRT);
    EXPECT_EQ(outcome.written, kWritten);
}

TEST(CrashStop, GuardsAreBoundedAndReused) {
    const Outcome outcome = after([](int first) {
        std::array<int, crash::kMaxGuarded> more{};
        for (int& each : more) each = crash::guard("/dev/null", kStop);
        if (more.back() != -1 || more[0] == -1) raise(SIGKILL); // one too many, for the first has one
        crash::unguard(more[0]);
        if (crash::guard("/dev/null", kStop) != more[0]) raise(SIGKILL);
        if (crash::guard("/nowhere/at/all", kStop) != -1) raise(SIGKILL);
        crash::unguard(first);
    });
    EXPECT_EQ(outcome.signal, 0);
}

} // namespace
} // namespace shoal::haptics
