#include "game/rules/Ground.h"

#include "game/rules/TimeRange.h"

#include <algorithm>

namespace shoal::game {

Ground groundAt(std::span<const GroundMark> marks, double videoLength_s, double time_s) {
    double presence = 0, heights = 0, weights = 0;
    for (const GroundMark& mark : marks) {
        const double weight = within(mark.from_s, mark.to_s, videoLength_s, time_s);
        presence = std::max(presence, weight);
        heights += weight * static_cast<double>(mark.height_m);
        weights += weight;
    }
    if (weights == 0) return {};
    return {static_cast<float>(heights / weights), static_cast<float>(presence)};
}

} // namespace shoal::game
