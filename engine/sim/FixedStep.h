// Turns display time into simulation ticks of exactly 1/120 s.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace shoal::sim {

constexpr int kTickRate_Hz = 120;
constexpr float kTick_s = 1.0f / kTickRate_Hz;

// Time is an integer number of 1/120 ns, so rounding errors do not add up: frames that sum to T seconds run
// exactly floor(120 T) ticks, whatever their lengths.
class FixedStep {
  public:
    // Longer times are cut to this, so that the game does not race after a breakpoint.
    static constexpr double kMaxCatchUp_s = 0.5;

    // Adds the time since the last call, seconds; negative or not finite counts as 0. Returns how many ticks
    // to run now, at most 60.
    int advance(double elapsed_s) {
        if (!std::isfinite(elapsed_s)) elapsed_s = 0;
        rest_ += std::llround(std::clamp(elapsed_s, 0.0, kMaxCatchUp_s) * 1e9) * kTickRate_Hz;
        const int64_t maximum = static_cast<int64_t>(kMaxCatchUp_s * kTickRate_Hz);
        const int64_t ticks = std::min(rest_ / kTick, maximum);
        rest_ = std::min(rest_ - ticks * kTick, kTick - 1);
        return static_cast<int>(ticks);
    }

    // Returns the time since the last tick, in ticks: 0 inclusive to 1 exclusive.
    float alpha() const {
        return std::min(static_cast<float>(static_cast<double>(rest_) / static_cast<double>(kTick)),
                        0x1.fffffep-1f);
    }

  private:
    static constexpr int64_t kTick = 1'000'000'000; // a tick, 1/120 ns
    int64_t rest_ = 0;                              // 1/120 ns
};

} // namespace shoal::sim
