#include "game/session/Statistics.h"

#include "engine/core/WriteFile.h"
#include "engine/math/Quantile.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <sys/resource.h>

namespace shoal::app {

static double quantile(Series series, double share) {
    return static_cast<double>(math::quantile(series, share));
}

void printTimes(const Statistics& s, bool live) {
    std::printf("%s: %zu frames, median %.2f ms, 99th percentile %.2f ms, worst %.2f ms\n",
                s.renderer.c_str(), s.frame_ms.size(), quantile(s.frame_ms, 0.5), quantile(s.frame_ms, 0.99),
                quantile(s.frame_ms, 1));
    if (!live) return;
    std::printf("live: %lld frames shown, %lld passed over; from arrival to picture median %.1f ms, 99th "
                "percentile %.1f ms; in pictures of the display %.0f and %.0f, at most %.0f\n",
                static_cast<long long>(s.live.shown), static_cast<long long>(s.live.passedOver),
                quantile(s.liveLatency_ms, 0.5), quantile(s.liveLatency_ms, 0.99),
                quantile(s.liveDisplayFrames, 0.5), quantile(s.liveDisplayFrames, 0.99),
                quantile(s.liveDisplayFrames, 1));
}

Status writeStatistics(const Path& file, const Statistics& s) {
    const auto summary = [](const Series& series) {
        return nlohmann::ordered_json{
            {"median", quantile(series, 0.5)}, {"p99", quantile(series, 0.99)}, {"max", quantile(series, 1)}};
    };
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    nlohmann::ordered_json json = {
        {"renderer", s.renderer},
        {"frames", s.frame_ms.size()},
        {"frame_ms", summary(s.frame_ms)},
        {"light_ms", summary(s.light_ms)},
        {"decode_ms", summary(s.decode_ms)},
        {"upload_ms", summary(s.upload_ms)},
        {"draws", s.draws},
        {"triangles", s.triangles},
        {"least_scale", s.minScale},
        {"caught", s.caught},
        {"score", s.score},
        {"state_hash", fmt::format("{:016x}", s.stateHash)},
        {"ticks", s.ticks},
        {"peak_rss_mb", static_cast<double>(usage.ru_maxrss) / 1024},
    };
    if (s.live.shown > 0)
        json["live"] = {{"latency_ms", summary(s.liveLatency_ms)},
                        {"display_frames", summary(s.liveDisplayFrames)},
                        {"shown", s.live.shown},
                        {"made", s.live.made},
                        {"passed_over", s.live.passedOver},
                        {"stops", s.live.stops},
                        {"losses", s.live.losses},
                        {"resized", s.live.resized}};
    return writeFileWhole(file, json.dump(2) + "\n");
}

} // namespace shoal::app
