#include "engine/sim/FixedStep.h"

#include <algorithm>
#include <cmath>

namespace shoal::sim {

namespace {
constexpr int64_t kTick = 1'000'000'000; // in units of 1/120 ns: a second holds 120 of them
}

int FixedStep::advance(double elapsed_s) {
    if (!std::isfinite(elapsed_s)) elapsed_s = 0;
    const double kept = std::clamp(elapsed_s, 0.0, kMaxCatchUp_s);
    rest_ += std::llround(kept * 1e9) * kTickRate_Hz;
    const int64_t maximum = static_cast<int64_t>(kMaxCatchUp_s * kTickRate_Hz);
    const int64_t ticks = std::min(rest_ / kTick, maximum);
    rest_ -= ticks * kTick;
    rest_ = std::min(rest_, kTick - 1);
    return static_cast<int>(ticks);
}

float FixedStep::alpha() const {
    return std::min(static_cast<float>(static_cast<double>(rest_) / static_cast<double>(kTick)),
                    0x1.fffffep-1f);
}

} // namespace shoal::sim
