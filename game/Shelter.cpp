#include "game/Shelter.h"

#include "game/Mark.h"

#include <algorithm>

namespace shoal::game {

float shelterAt(std::span<const Shelter> marks, double videoLength_s, double time_s) {
    double most = 0;
    for (const Shelter& mark : marks)
        most = std::max(most, static_cast<double>(mark.amount) *
                                  within(mark.from_s, mark.to_s, videoLength_s, time_s));
    return static_cast<float>(most);
}

} // namespace shoal::game
