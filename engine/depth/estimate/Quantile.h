// The value that a share of all are less than.
#pragma once

#include <algorithm>
#include <vector>

namespace shoal::depth {

// 0 where there is nothing; of two in the middle the median is the upper one. Reorders the values.
inline double quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

inline double median(std::vector<double>& values) { return quantile(values, 0.5); }

} // namespace shoal::depth
