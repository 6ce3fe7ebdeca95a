// Signal handlers that stop all motors when the program dies: they write reports prepared before, with
// nothing but what POSIX allows in a handler. The one place with global state, because signals belong to the
// process. SIGKILL cannot be caught; a glove then stops by its watchdog, Nintendo's controllers by
// themselves.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace shoal::haptics::crash {

constexpr int kMaxGuarded = 16;

// Handlers for the signals that end a program (SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTERM, SIGINT,
// SIGHUP, SIGQUIT), once; afterwards the signal does what it did before. Ignored ones stay ignored. The
// calling thread's handlers run on a stack of their own, so that even a stack overflow is caught.
void install();

// Opens the device once more, for the handler alone. The report is at most kMaxReportBytes. A number for
// unguard(), or -1 if it cannot be done.
int guard(const std::string& path, std::span<const uint8_t> stop);
void unguard(int number);

// Around each writing to a device: the handler waits (a moment) for the one in work, and allows no other, so
// that the stop is the last report that a device receives.
class Writing {
  public:
    Writing();
    ~Writing();
    Writing(const Writing&) = delete;
    Writing& operator=(const Writing&) = delete;
    bool allowed() const { return allowed_; }

  private:
    bool allowed_;
};

} // namespace shoal::haptics::crash
