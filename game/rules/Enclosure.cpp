#include "game/rules/Enclosure.h"

#include "game/rules/TimeRange.h"

#include <algorithm>

namespace shoal::game {

float enclosureAt(std::span<const Enclosure> marks, double videoLength_s, double time_s) {
    double maximum = 0;
    for (const Enclosure& mark : marks)
        maximum = std::max(maximum, static_cast<double>(mark.amount) *
                                        within(mark.from_s, mark.to_s, videoLength_s, time_s));
    return static_cast<float>(maximum);
}

} // namespace shoal::game
