// Keeps what comes faster than its own time stamps say from running away: a file on a server, or one that is
// written into a pipe. What is live never has to wait.
#pragma once

#include <algorithm>

namespace shoal::media {

// A bucket of time: it fills as time passes, and each picture takes out what it lasts.
class Pace {
  public:
    // ahead_s: how much may come at once: a server that sends the last seconds first is still live.
    explicit Pace(double ahead_s) : most_s_(ahead_s), left_s_(ahead_s) {}

    // Something stamped stamp_s came at now_s: how many seconds to wait before it is passed on.
    double wait_s(double stamp_s, double now_s) {
        if (!began_) {
            began_ = true;
            stamp_s_ = stamp_s;
            now_s_ = now_s;
            return 0;
        }
        // Clocks of senders are not ours; they run ahead of it by less than this.
        constexpr double kDrift = 1e-3;
        left_s_ = std::min(left_s_ + (now_s - now_s_) * (1 + kDrift), most_s_);
        now_s_ = now_s;
        const double lasts_s = stamp_s - stamp_s_;
        stamp_s_ = stamp_s;
        if (lasts_s > 0 && lasts_s < kJump_s) left_s_ -= lasts_s; // else the stamps began anew
        return std::max(0.0, -left_s_);
    }

  private:
    static constexpr double kJump_s = 10;
    double most_s_, left_s_;
    bool began_ = false;
    double stamp_s_ = 0, now_s_ = 0;
};

} // namespace shoal::media
