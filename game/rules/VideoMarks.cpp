#include "game/rules/VideoMarks.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {

// How far the time lies within a mark, 0 to 1.
template <class Mark> double within(const Mark& mark, double videoLength_s, double time_s) {
    constexpr double kRamp_s = 2;
    const auto from_s = static_cast<double>(mark.from_s);
    if (!(videoLength_s > 0) || from_s >= videoLength_s) return 0;
    const double to_s = std::min(static_cast<double>(mark.to_s), videoLength_s);
    const auto wrapped = [&](double s) { return s - std::floor(s / videoLength_s) * videoLength_s; };
    const double now_s = wrapped(time_s);
    const bool inside = now_s >= from_s && now_s <= to_s;
    const double away_s = inside ? 0 : std::min(wrapped(from_s - now_s), wrapped(now_s - to_s));
    return std::max(0.0, 1 - away_s / kRamp_s);
}

} // namespace

float enclosureAt(std::span<const Enclosure> marks, double videoLength_s, double time_s) {
    double maximum = 0;
    for (const Enclosure& mark : marks)
        maximum = std::max(maximum, static_cast<double>(mark.amount) * within(mark, videoLength_s, time_s));
    return static_cast<float>(maximum);
}

Ground groundAt(std::span<const GroundMark> marks, double videoLength_s, double time_s) {
    double presence = 0, heights = 0, weights = 0;
    for (const GroundMark& mark : marks) {
        const double weight = within(mark, videoLength_s, time_s);
        presence = std::max(presence, weight);
        heights += weight * static_cast<double>(mark.height_m);
        weights += weight;
    }
    if (weights == 0) return {};
    return {static_cast<float>(heights / weights), static_cast<float>(presence)};
}

} // namespace shoal::game
