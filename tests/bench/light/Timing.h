// The shortest of many runs: what a thing costs when nobody else uses the machine.
#pragma once

#include <algorithm>
#include <chrono>

namespace shoal::bench {

inline double now_us() {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Runs once to warm up, then for budget_ms, three times at the least.
template <class Run> double shortest_us(double budget_ms, Run&& run) {
    run();
    double best = 1e30;
    const double end = now_us() + 1e3 * budget_ms;
    for (int i = 0; i < 3 || now_us() < end; ++i) {
        const double begin = now_us();
        run();
        best = std::min(best, now_us() - begin);
    }
    return best;
}

} // namespace shoal::bench
