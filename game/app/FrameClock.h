// The time that a frame of a dive is worth, and when it is drawn.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace shoal::app {

class FrameClock {
  public:
    enum class Mode {
        RealTime,  // somebody looks on: time is the clock's
        FixedStep, // every picture is 1 / fps after the one before, and shows just its frame of the video
        TimeDemo   // the same for the dive, as fast as it can; the video keeps the clock's time
    };
    FrameClock(Mode mode, double fps) : mode_(mode), fps_(fps) {}

    void beginFrame();
    uint64_t frame() const { return frame_; } // 0 is the first
    double sinceBegin_ms() const;             // of this frame

    // Of the dive since the frame before. display: what a display says that passed between two pictures.
    double elapsed_s(std::optional<double> display) const;
    double video_s(double dive_s) const;
    bool exactVideo() const { return mode_ == Mode::FixedStep; }

    // At a frame's end, where a live video is shown, which has the clock's time: lets fixed steps go no
    // faster.
    void waitForLiveVideo() const;
    // Until this frame has lasted so long.
    void waste(double load_ms) const;

  private:
    using Clock = std::chrono::steady_clock;
    Mode mode_;
    double fps_;
    uint64_t frame_ = 0;
    bool begun_ = false;
    Clock::time_point start_, frameStart_;
    double wall_s_ = 0; // from the frame before to this one
};

} // namespace shoal::app
