// Values that follow others over time.
#pragma once

#include <algorithm>
#include <cmath>

namespace shoal::math {

// The share of the way to a goal that is gone in dt_s, where what is left falls to 1/e in constant_s.
inline float followShare(float dt_s, float constant_s) {
    return 1 - std::exp(-std::max(dt_s, 0.0f) / constant_s);
}

} // namespace shoal::math
