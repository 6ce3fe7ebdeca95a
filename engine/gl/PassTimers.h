// Measures the time of each render pass on the graphics card and on the context's thread, which alone may use
// this, and opens debug groups by which a frame debugger names the passes.
#pragma once

#include "engine/gl/Objects.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace shoal {

// Time that a thread spends in each part of a frame. Parts nest; the time of an inner part does not count for
// the outer one.
class PartTimes {
  public:
    // The part lasts as long as this object. times: may be null. part: a string literal.
    class Scope {
      public:
        Scope(PartTimes* times, const char* part)
            : times_(times), outer_(times ? times->enter(times->indexOf(part)) : 0) {}
        ~Scope() {
            if (times_) times_->enter(outer_);
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        PartTimes* times_;
        size_t outer_;
    };
    struct Time {
        const char* part;
        float ms; // 0: the frame had no such part
    };

    void beginFrame() {
        for (Time& time : times_) time.ms = 0;
        since_ = Clock::now();
    }
    // Returns the frame's times so far. The first is the time spent outside of all parts.
    std::span<const Time> times() const { return times_; }

  private:
    using Clock = std::chrono::steady_clock;

    size_t indexOf(std::string_view part) {
        for (size_t i = 0; i < times_.size(); ++i)
            if (times_[i].part == part) return i;
        times_.push_back({part.data(), 0});
        return times_.size() - 1;
    }
    // Ends the present part, begins this one, and returns the index of the one that ended.
    size_t enter(size_t part) {
        const Clock::time_point now = Clock::now();
        times_[inner_].ms += std::chrono::duration<float, std::milli>(now - since_).count();
        since_ = now;
        return std::exchange(inner_, part);
    }

    std::vector<Time> times_{{"other", 0}};
    size_t inner_ = 0; // index of the innermost part
    Clock::time_point since_ = Clock::now();
};

// Runs the part and returns its result. times: may be null.
template <class Run> auto timed(PartTimes* times, const char* part, Run&& run) {
    const PartTimes::Scope scope(times, part);
    return run();
}

} // namespace shoal

namespace shoal::gl {

class PassTimers {
  public:
    // Times all draws during its life, those of scopes inside it too, as a pass. pass: a string literal.
    class Scope {
      public:
        Scope(PassTimers* timers, const char* pass); // timers: may be null
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        PassTimers* timers_;
        size_t span_;
        PartTimes::Scope onThread_;
    };

    struct Time {
        const char* pass;
        float gpu_ms;
    };

    // Call it once a frame. measured: whether the card's times of the frame that begins are taken; the
    // thread's always are, and debug groups opened.
    void beginFrame(bool measured);
    // Returns the newest times that have arrived, from four or more frames back, so that it never waits.
    std::span<const Time> times() const { return times_; }
    PartTimes& onThread() { return onThread_; }

  private:
    struct Span {
        const char* pass;
        Query begin, end;
    };
    struct Frame {
        std::vector<Span> spans; // kept from frame to frame
        size_t used = 0;
    };
    void read(Frame& frame);

    std::array<Frame, 4> frames_;
    size_t current_ = 0;
    bool measured_ = false;
    bool groups_ = epoxy_gl_version() >= 43 || epoxy_has_gl_extension("GL_KHR_debug");
    std::vector<Time> times_;
    PartTimes onThread_;
};

} // namespace shoal::gl
