// The value that a share of all are less than.
#pragma once

#include <algorithm>
#include <vector>

namespace shoal::math {

// 0 where there is nothing; of two in the middle the median is the upper one. Reorders the values.
template <class T> T quantile(std::vector<T>& values, double share) {
    if (values.empty()) return T(0);
    const auto count = static_cast<double>(values.size());
    const auto at = values.begin() + static_cast<ptrdiff_t>(std::min(share * count, count - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

template <class T> T median(std::vector<T>& values) { return quantile(values, 0.5); }

} // namespace shoal::math
