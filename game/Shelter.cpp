#include "game/Shelter.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {
constexpr double kRamp_s = 2;
}

float shelterAt(std::span<const Shelter> marks, double videoLength_s, double time_s) {
    if (!(videoLength_s > 0)) return 0;
    const auto wrapped = [&](double s) { return s - std::floor(s / videoLength_s) * videoLength_s; };
    const double now_s = wrapped(time_s);
    double most = 0;
    for (const Shelter& mark : marks) {
        const auto from_s = static_cast<double>(mark.from_s);
        if (from_s >= videoLength_s) continue; // of a longer video
        const double to_s = std::min(static_cast<double>(mark.to_s), videoLength_s);
        const bool inside = now_s >= from_s && now_s <= to_s;
        const double away_s = inside ? 0 : std::min(wrapped(from_s - now_s), wrapped(now_s - to_s));
        most = std::max(most, static_cast<double>(mark.amount) * std::max(0.0, 1 - away_s / kRamp_s));
    }
    return static_cast<float>(most);
}

} // namespace shoal::game
