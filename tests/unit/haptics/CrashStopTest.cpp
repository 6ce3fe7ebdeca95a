// Files stand for devices here; umockdev.dies_by_* does the same with hidapi's.
#include "engine/core/Files.h"
#include "input/haptics/HidBus.h"
#include "tests/Test.h"

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>

namespace shoal::haptics {
namespace {

const std::array<uint8_t, 4> kStop = {5, 0, '%', 255};
const std::string kWritten(kStop.begin(), kStop.end());

struct GuardedFile {
    std::string name = testing::TempDir() + "crash_" + std::to_string(getpid());

    GuardedFile() { std::ofstream(name).close(); }
    ~GuardedFile() { std::remove(name.c_str()); }
    std::string read() const { return tests::valueOf(readText(name)); }
};

TEST(CrashStop, WritesTheStopHoweverTheProgramDies) {
    for (const int signal : {0, SIGSEGV, SIGABRT, SIGFPE, SIGTERM, SIGINT, SIGHUP, SIGKILL}) {
        const GuardedFile file;
        const pid_t child = fork();
        if (child == 0) {
            const rlimit none{0, 0};
            setrlimit(RLIMIT_CORE, &none);
            const CrashStop guard(file.name, kStop);
            std::signal(signal, SIG_DFL);
            if (signal != 0) raise(signal);
            _exit(0); // without destructors
        }
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        EXPECT_EQ(WIFSIGNALED(status) ? WTERMSIG(status) : 0, signal);
        while (file.read().size() < kStop.size()) std::this_thread::yield(); // the test's time limit ends it
        EXPECT_EQ(file.read(), kWritten) << signal;
    }
}

TEST(CrashStop, LeavesADeviceAloneThatWasClosedBefore) {
    const GuardedFile file;
    { const CrashStop guard(file.name, kStop); }
    EXPECT_EQ(file.read(), ""); // the destructor waits for the helper's end
}

TEST(CrashStop, ASignalForTheWholeGroupDoesNotEndTheHelper) {
    const GuardedFile file;
    const pid_t child = fork();
    if (child == 0) {
        setpgid(0, 0);
        std::signal(SIGINT, SIG_IGN); // of the program itself, so that the helper has time to ignore its own
        const CrashStop guard(file.name, kStop);
        kill(0, SIGINT); // as Ctrl+C sends it
        raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    while (file.read().size() < kStop.size()) std::this_thread::yield();
    EXPECT_EQ(file.read(), kWritten);
}

} // namespace
} // namespace shoal::haptics
