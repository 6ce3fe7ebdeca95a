#include "input/haptics/CrashStop.h"

#include "input/haptics/DeviceTable.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <mutex>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace shoal::haptics::crash {

namespace {

constexpr std::array<int, 9> kSignals = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT,
                                         SIGTERM, SIGINT, SIGHUP, SIGQUIT};
constexpr int kWait_ms = 100;                         // for a writing in work
static_assert(std::atomic<int>::is_always_lock_free); // else a handler might not use them

struct Guarded {
    std::atomic<int> file{-1}; // written last by guard(), so that the report before it is whole
    std::atomic<bool> taken{false};
    Report stop;
};

std::array<Guarded, kMaxGuarded> guarded;
std::array<struct sigaction, kSignals.size()> before;
std::atomic<int> writer{0}; // the thread that is writing, 0 if none
std::atomic<bool> dying{false};
alignas(16) std::array<char, 65536> handlersStack;

int thisThread() { return static_cast<int>(syscall(SYS_gettid)); }

void stopAll() {
    if (dying.exchange(true)) return;
    const int self = thisThread();
    for (int waited_ms = 0; waited_ms < kWait_ms; ++waited_ms) {
        const int who = writer.load();
        if (who == 0 || who == self) break;
        poll(nullptr, 0, 1);
    }
    for (const Guarded& each : guarded)
        if (const int file = each.file.load(); file >= 0)
            if (write(file, each.stop.bytes.data(), each.stop.size) < 0) continue; // it is gone: silent too
}

void handle(int signal, siginfo_t* info, void*) {
    const int error = errno;
    stopAll();
    for (size_t i = 0; i < kSignals.size(); ++i)
        if (kSignals[i] == signal) sigaction(signal, &before[i], nullptr);
    // A fault happens again on return, now with the handler of before; all else is sent again.
    const bool fault = info && info->si_code > 0 && signal != SIGABRT && signal != SIGTERM &&
                       signal != SIGINT && signal != SIGHUP && signal != SIGQUIT;
    if (!fault) raise(signal);
    errno = error;
}

} // namespace

void install() {
    static std::once_flag once;
    std::call_once(once, [] {
        stack_t stack{}, had{};
        stack.ss_sp = handlersStack.data();
        stack.ss_size = handlersStack.size();
        if (sigaltstack(nullptr, &had) == 0 && (had.ss_flags & SS_DISABLE)) sigaltstack(&stack, nullptr);
        for (size_t i = 0; i < kSignals.size(); ++i) {
            sigaction(kSignals[i], nullptr, &before[i]);
            if (!(before[i].sa_flags & SA_SIGINFO) && before[i].sa_handler == SIG_IGN) continue;
            struct sigaction action {};
            action.sa_sigaction = handle;
            action.sa_flags = SA_SIGINFO | SA_ONSTACK;
            sigfillset(&action.sa_mask);
            sigaction(kSignals[i], &action, nullptr);
        }
    });
}

int guard(const std::string& path, std::span<const uint8_t> stop) {
    if (stop.size() > kMaxReportBytes) return -1;
    const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return -1;
    for (size_t i = 0; i < guarded.size(); ++i) {
        if (guarded[i].taken.exchange(true)) continue;
        std::copy(stop.begin(), stop.end(), guarded[i].stop.bytes.begin());
        guarded[i].stop.size = stop.size();
        guarded[i].file.store(file);
        return static_cast<int>(i);
    }
    close(file);
    return -1;
}

void unguard(int number) {
    if (dying.load()) return; // the handler still wants it
    Guarded& each = guarded[static_cast<size_t>(number)];
    const int file = each.file.exchange(-1);
    if (file >= 0) close(file);
    each.taken.store(false);
}

// First the own mark, then the look at the other's: one of the two sees the other.
Writing::Writing() {
    writer.store(thisThread());
    allowed_ = !dying.load();
    if (!allowed_) writer.store(0);
}
Writing::~Writing() {
    if (allowed_) writer.store(0);
}

} // namespace shoal::haptics::crash
