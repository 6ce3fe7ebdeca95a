// Headers and small helpers that most benches use: times (the shortest of many runs, which is the cost on a
// machine that nobody else uses), all cores, and the exit status.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/core/ThreadPool.h"
#include "engine/core/WriteFile.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shoal::bench {

inline double now_us() {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Processor time of all threads of this program, which other programs change little.
inline double processor_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

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

// Runs job(i) for 0 .. count - 1 on all cores.
template <class Job> void onAllCores(size_t count, Job&& job) {
    ThreadPool(std::max(0, static_cast<int>(std::thread::hardware_concurrency()) - 1))
        .parallelFor(static_cast<int>(count), [&](int i) { job(static_cast<size_t>(i)); });
}

// Says how a program is used if it was started with too few arguments.
inline bool lacksArguments(int argc, int least, const char* usage) {
    if (argc <= least) std::fprintf(stderr, "usage: %s\n", usage);
    return argc <= least;
}

// Returns the exit status of a program, and says what went wrong.
inline int exitStatus(const char* program, const Status& done) {
    if (!done) std::fprintf(stderr, "%s: %s\n", program, done.error().message().c_str());
    return done ? 0 : 1;
}

} // namespace shoal::bench
