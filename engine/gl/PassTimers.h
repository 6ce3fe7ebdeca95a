// Measures the time of each render pass on the graphics card and on the context's thread, which alone may use
// this, and opens debug groups by which a frame debugger names the passes.
#pragma once

#include "engine/core/PartTimes.h"
#include "engine/gl/Objects.h"

#include <array>
#include <span>
#include <vector>

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
    bool measured_ = false, known_ = false, groups_ = false;
    std::vector<Time> times_;
    PartTimes onThread_;
};

} // namespace shoal::gl
