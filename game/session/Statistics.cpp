#include "game/session/Statistics.h"

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

void LiveStatistics::add(const media::LivePlayer& live, bool fresh) {
    counts = live.counts();
    if (!fresh) return;
    latency_ms.add(1e3 * live.age_s());
    displayFrames.add(live.displayFrames());
}

std::string describe(const LiveStatistics& live) {
    char line[256];
    std::snprintf(line, sizeof line,
                  "live: %lld frames shown, %lld passed over; from arrival to picture median %.1f ms, 99th "
                  "percentile %.1f ms; in pictures of the display %.0f and %.0f, at most %.0f",
                  static_cast<long long>(live.counts.shown), static_cast<long long>(live.counts.passedOver),
                  live.latency_ms.quantile(0.5), live.latency_ms.quantile(0.99),
                  live.displayFrames.quantile(0.5), live.displayFrames.quantile(0.99),
                  live.displayFrames.quantile(1));
    return line;
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
    nlohmann::ordered_json json = {
        {"renderer", s.renderer},
        {"frames", s.frame_ms.count()},
        {"frame_ms", summary(s.frame_ms)},
        {"light_ms", summary(s.light_ms)},
        {"decode_ms", summary(s.decode_ms)},
        {"upload_ms", summary(s.upload_ms)},
        {"draws", s.draws},
        {"triangles", s.triangles},
        {"least_scale", s.minScale},
        {"caught", s.caught},
        {"score", s.score},
        {"state_hash", hash},
        {"ticks", s.ticks},
        {"peak_rss_mb", peakResident_MiB()},
    };
    if (s.live.counts.shown > 0)
        json["live"] = {{"latency_ms", summary(s.live.latency_ms)},
                        {"display_frames", summary(s.live.displayFrames)},
                        {"shown", s.live.counts.shown},
                        {"made", s.live.counts.made},
                        {"passed_over", s.live.counts.passedOver},
                        {"stops", s.live.counts.stops},
                        {"losses", s.live.counts.losses},
                        {"resized", s.live.counts.resized}};
    return writeFileWhole(file, json.dump(2) + "\n");
}

} // namespace shoal::app
