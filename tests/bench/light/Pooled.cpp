#include "tests/bench/light/Pooled.h"

#include <algorithm>
#include <cmath>

namespace shoal::bench {

Pool pooled(const Chart& chart, const Measured& method, Suns suns, size_t firstLobe, size_t lobes) {
    Pool pool;
    for (size_t s = 0; s < chart.environments.size(); ++s) {
        const bool sun = chart.environments[s].pointSun;
        if ((suns == Suns::Without && sun) || (suns == Suns::Only && !sun)) continue;
        for (size_t k = firstLobe; k < firstLobe + lobes; ++k) pool.add(method.errors[s][k]);
    }
    return pool;
}

double medianOfToneMap(const Chart& chart, const Measured& method, bool film, size_t lobe) {
    std::vector<double> errors;
    for (size_t i = film ? chart.toneMapsClipped : 0;
         i < (film ? method.errors.size() : chart.toneMapsClipped); ++i)
        errors.push_back(method.errors[i][lobe].rms);
    if (errors.empty()) return std::nan("");
    std::ranges::sort(errors);
    return (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]) / 2;
}

double frame_us(const Cost& cost, double pixels) { return cost.update_us + 1e-3 * cost.shade_ns * pixels; }

} // namespace shoal::bench
