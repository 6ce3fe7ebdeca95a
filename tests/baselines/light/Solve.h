// Small systems of linear equations.
#pragma once

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace shoal::light::baselines {

// Solves A X = B in place by Gauss' elimination with row pivots; a: size x size, b: size x columns, row by
// row. b becomes X. A is not singular.
inline void solve(std::vector<double>& a, std::vector<double>& b, size_t size) {
    const size_t columns = b.size() / size;
    for (size_t k = 0; k < size; ++k) {
        size_t pivot = k;
        for (size_t i = k + 1; i < size; ++i)
            if (std::abs(a[i * size + k]) > std::abs(a[pivot * size + k])) pivot = i;
        assert(a[pivot * size + k] != 0);
        for (size_t j = 0; j < size; ++j) std::swap(a[k * size + j], a[pivot * size + j]);
        for (size_t j = 0; j < columns; ++j) std::swap(b[k * columns + j], b[pivot * columns + j]);
        for (size_t i = 0; i < size; ++i) {
            if (i == k) continue;
            const double times = a[i * size + k] / a[k * size + k];
            for (size_t j = k; j < size; ++j) a[i * size + j] -= times * a[k * size + j];
            for (size_t j = 0; j < columns; ++j) b[i * columns + j] -= times * b[k * columns + j];
        }
    }
    for (size_t k = 0; k < size; ++k)
        for (size_t j = 0; j < columns; ++j) b[k * columns + j] /= a[k * size + k];
}

} // namespace shoal::light::baselines
