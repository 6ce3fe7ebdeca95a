#include "input/haptics/HapticOutput.h"

#include "engine/core/Log.h"
#include "input/haptics/Rack.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <semaphore.h>
#include <thread>

namespace shoal::haptics {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kStopping_s = 0.1; // for the last reports, each at its device's pace

struct Submitted {
    HapticFrame frame;
    Clock::time_point when{};
};

// Hands the newest value from one thread to another: three slots, of which the writer owns one, the reader
// one, and the one between is swapped. Neither side ever waits.
class Mailbox {
  public:
    void put(const Submitted& value) {
        slots_[writing_] = value;
        writing_ = between_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
    }
    const Submitted& newest() {
        if (between_.load(std::memory_order_acquire) & kFresh)
            reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & ~kFresh;
        return slots_[reading_];
    }

  private:
    static constexpr unsigned kFresh = 4;
    std::array<Submitted, 3> slots_{};
    std::atomic<unsigned> between_{1};
    unsigned writing_ = 0, reading_ = 2;
};

// Wakes the writing thread. POSIX's, because its post neither waits nor takes a lock.
class Bell {
  public:
    Bell() { sem_init(&semaphore_, 0, 0); }
    ~Bell() { sem_destroy(&semaphore_); }
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    void ring() { sem_post(&semaphore_); }
    void waitAtMost(double seconds) {
        timespec until{};
        clock_gettime(CLOCK_MONOTONIC, &until);
        const double whole = std::floor(seconds);
        until.tv_sec += static_cast<time_t>(whole);
        until.tv_nsec += static_cast<long>((seconds - whole) * 1e9);
        if (until.tv_nsec >= 1'000'000'000) until.tv_nsec -= 1'000'000'000, ++until.tv_sec;
        sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until);
        while (sem_trywait(&semaphore_) == 0) { // several rings are one
        }
    }

  private:
    sem_t semaphore_;
};

double secondsSince(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

} // namespace

struct HapticOutput::State {
    Mailbox mailbox;
    Bell bell;
    std::atomic<bool> stop{false};
    std::thread thread;

    explicit State(HidBus bus) {
        thread = std::thread([this, bus = std::move(bus)] { run(bus); });
    }
    ~State() {
        stop = true;
        bell.ring();
        thread.join();
    }

    void run(const HidBus& bus) {
        Rack rack(bus);
        const Clock::time_point began = Clock::now();
        while (!stop) {
            const Submitted& newest = mailbox.newest();
            const double left_s = kFelt_s - secondsSince(newest.when);
            const double next_s = rack.step(left_s > 0 ? newest.frame : HapticFrame(), secondsSince(began));
            for (const std::string& complaint : rack.takeComplaints()) log::warn("{}", complaint);
            bell.waitAtMost(left_s > 0 ? std::min(next_s, left_s) : next_s);
        }
        const Clock::time_point stopping = Clock::now();
        while (!rack.still() && secondsSince(stopping) < kStopping_s) {
            const double next_s = rack.step({}, secondsSince(began));
            if (!rack.still()) bell.waitAtMost(std::min(next_s, kStopping_s));
        }
    }
};

HapticOutput::HapticOutput(HidBus bus) : state_(std::make_unique<State>(std::move(bus))) {}
HapticOutput::HapticOutput(HapticOutput&&) noexcept = default;
HapticOutput& HapticOutput::operator=(HapticOutput&&) noexcept = default;
HapticOutput::~HapticOutput() = default;

void HapticOutput::submit(const HapticFrame& frame) {
    state_->mailbox.put({frame, Clock::now()});
    state_->bell.ring();
}

} // namespace shoal::haptics
