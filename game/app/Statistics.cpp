#include "game/app/Statistics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sys/resource.h>

namespace shoal::app {

double Series::quantile(double q) const {
    if (values_.empty()) return 0;
    std::vector<float> sorted = values_;
    const auto rank = static_cast<size_t>(std::lround(q * static_cast<double>(sorted.size() - 1)));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<ptrdiff_t>(rank), sorted.end());
    return static_cast<double>(sorted[rank]);
}

double peakResident_MiB() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

Status writeStatistics(const Path& file, const Statistics& s) {
    const auto summary = [](const Series& series) {
        return nlohmann::ordered_json{
            {"median", series.quantile(0.5)}, {"p99", series.quantile(0.99)}, {"max", series.quantile(1)}};
    };
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(s.stateHash));
    const nlohmann::ordered_json json = {
        {"renderer", s.renderer},
        {"frames", s.frame_ms.count()},
        {"frame_ms", summary(s.frame_ms)},
        {"light_ms", summary(s.light_ms)},
        {"decode_ms", summary(s.decode_ms)},
        {"upload_ms", summary(s.upload_ms)},
        {"draws", s.draws},
        {"triangles", s.triangles},
        {"least_scale", s.leastScale},
        {"caught", s.caught},
        {"score", s.score},
        {"state_hash", hash},
        {"ticks", s.ticks},
        {"peak_rss_mb", peakResident_MiB()},
    };
    return writeFileWhole(file, json.dump(2) + "\n");
}

} // namespace shoal::app
