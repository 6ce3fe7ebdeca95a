// From display time to simulation ticks of exactly 1/120 s.
#pragma once

#include <cstdint>

namespace shoal::sim {

constexpr int kTickRate_Hz = 120;
constexpr float kTick_s = 1.0f / kTickRate_Hz;

// Time is kept as a whole number of 1/120 ns, so no rounding piles up: frames that sum to T seconds run
// exactly floor(120 T) ticks, whatever their lengths.
class FixedStep {
  public:
    static constexpr double kMaxCatchUp_s =
        0.5; // more is forgotten: after a breakpoint the game does not race

    // Adds the time since the last call, seconds; negative or not finite counts as 0. Returns how many ticks
    // to run now, at most 60.
    int advance(double elapsed_s);

    // How far display time is past the last tick, in ticks: 0 inclusive to 1 exclusive.
    float alpha() const;

  private:
    int64_t rest_ = 0; // 1/120 ns
};

} // namespace shoal::sim
