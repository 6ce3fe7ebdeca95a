// Quantiles: the value below which a given share of all values lies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace shoal::math {

// Returns 0 without values; the median of an even number is the upper middle one. Reorders the values.
template <class T> T quantile(std::vector<T>& values, double share) {
    if (values.empty()) return T(0);
    const auto count = static_cast<double>(values.size());
    const auto at = values.begin() + static_cast<ptrdiff_t>(std::min(share * count, count - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

template <class T> T median(std::vector<T>& values) { return quantile(values, 0.5); }

} // namespace shoal::math
