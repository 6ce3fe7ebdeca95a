// Rate limiter of live streams.
#pragma once

#include <algorithm>

namespace shoal::media {

// Limits packets that come faster than their own time stamps (a file on a server, or written into a pipe) to
// these. A token bucket of seconds: it fills as time passes, and each picture takes its duration. What is
// live never has to wait.
class TokenBucket {
  public:
    // burst_s: how much may come at once: a server that sends the last seconds first is still live.
    explicit TokenBucket(double burst_s) : max_s_(burst_s), left_s_(burst_s) {}

    // Seconds that a packet stamped stamp_s, which came at now_s, has to wait.
    double wait_s(double stamp_s, double now_s) {
        if (!began_) {
            began_ = true;
            stamp_s_ = stamp_s;
            now_s_ = now_s;
            return 0;
        }
        // Senders' clocks run faster than ours by less than this.
        constexpr double kDrift = 1e-3;
        left_s_ = std::min(left_s_ + (now_s - now_s_) * (1 + kDrift), max_s_);
        now_s_ = now_s;
        const double duration_s = stamp_s - stamp_s_;
        stamp_s_ = stamp_s;
        if (duration_s > 0 && duration_s < kJump_s) left_s_ -= duration_s; // else the stamps restarted
        return std::max(0.0, -left_s_);
    }

  private:
    static constexpr double kJump_s = 10;
    double max_s_, left_s_;
    bool began_ = false;
    double stamp_s_ = 0, now_s_ = 0;
};

} // namespace shoal::media
