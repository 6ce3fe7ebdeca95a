#include "game/rules/TimeRange.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

double within(float markFrom_s, float markTo_s, double videoLength_s, double time_s) {
    constexpr double kRamp_s = 2;
    const auto from_s = static_cast<double>(markFrom_s);
    if (!(videoLength_s > 0) || from_s >= videoLength_s) return 0;
    const double to_s = std::min(static_cast<double>(markTo_s), videoLength_s);
    const auto wrapped = [&](double s) { return s - std::floor(s / videoLength_s) * videoLength_s; };
    const double now_s = wrapped(time_s);
    const bool inside = now_s >= from_s && now_s <= to_s;
    const double away_s = inside ? 0 : std::min(wrapped(from_s - now_s), wrapped(now_s - to_s));
    return std::max(0.0, 1 - away_s / kRamp_s);
}

} // namespace shoal::game
