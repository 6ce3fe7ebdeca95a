#include "tests/bench/light/Pooled.h"

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

double frame_us(const Cost& cost, double pixels) { return cost.update_us + 1e-3 * cost.shade_ns * pixels; }

} // namespace shoal::bench
