// The command `play`: plays a dive, with a picture or without.
#include "engine/core/WriteFile.h"
#include "engine/math/Quantile.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"
#include "game/app/Application.h"
#include "game/tools/Commands.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <sys/resource.h>

namespace shoal::app {

// Makes these signals set stopSignal from now on; a second signal of the same kind ends the program at once.
static void noteStopSignals() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { stopSignal = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // nohup ignores SIGHUP
    }
}

// Checks, before anything is played, that all output files can be written.
static Status checkOutputsOf(const PlayOptions& options) {
    if (!options.screenshot.empty() && media::writtenAs(options.screenshot) != media::WrittenAs::Png)
        return Error{options.screenshot, "screenshots are PNG files; let the name end in .png"};
    const std::string& hands = options.hands.source; // such as replay:FILE
    const std::array outputs = {NamedFile{"--screenshot", options.screenshot},
                                NamedFile{"--record", options.record}, NamedFile{"--stats", options.stats}};
    const EnvironmentOptions& shown = options.environment;
    const std::array inputs = {NamedFile{"--hands", hands.substr(hands.find(':') + 1)},
                               NamedFile{"--video", shown.video}, NamedFile{"--photo", shown.photo},
                               NamedFile{"--env", shown.env}};
    return checkOutputs(outputs, inputs);
}

static double quantile(Series series, double share) {
    return static_cast<double>(math::quantile(series, share));
}

// Prints each part's median time, and its mean in the slowest hundredth of the frames.
static void printParts(const Statistics& s) {
    const double slow_ms = quantile(s.frame_ms, 0.99);
    for (const auto& [part, times_ms] : s.parts) {
        double sum_ms = 0, count = 0;
        for (size_t i = 0; i < times_ms.size(); ++i)
            if (static_cast<double>(s.frame_ms[i]) >= slow_ms)
                sum_ms += static_cast<double>(times_ms[i]), ++count;
        std::printf("%24s %7.3f ms, %7.3f ms in the slowest hundredth\n", part, quantile(times_ms, 0.5),
                    sum_ms / std::max(count, 1.0));
    }
    for (const auto& [part, times_ms] :
         {std::pair("decoding, own thread", &s.decode_ms), {"light, own thread", &s.light_ms}})
        std::printf("%24s %7.3f ms, %7.3f ms in the slowest hundredth of the film's frames\n", part,
                    quantile(*times_ms, 0.5), quantile(*times_ms, 0.99));
}

// Prints the times for a person to read.
static void printTimes(const Statistics& s) {
    std::printf("%s: %zu frames, median %.2f ms, 99th percentile %.2f ms, worst %.2f ms\n",
                s.renderer.c_str(), s.frame_ms.size(), quantile(s.frame_ms, 0.5), quantile(s.frame_ms, 0.99),
                quantile(s.frame_ms, 1));
    printParts(s);
    if (s.live.shown == 0) return; // no live video
    std::printf("live: %lld frames shown, %lld passed over; from arrival to picture median %.1f ms, 99th "
                "percentile %.1f ms; in pictures of the display %.0f and %.0f, at most %.0f\n",
                static_cast<long long>(s.live.shown), static_cast<long long>(s.live.skipped),
                quantile(s.liveLatency_ms, 0.5), quantile(s.liveLatency_ms, 0.99),
                quantile(s.liveDisplayFrames, 0.5), quantile(s.liveDisplayFrames, 0.99),
                quantile(s.liveDisplayFrames, 1));
}

static Status writeStatistics(const Path& file, const Statistics& s) {
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
                        {"passed_over", s.live.skipped},
                        {"stops", s.live.stops},
                        {"losses", s.live.losses},
                        {"resized", s.live.resized}};
    return writeFileWhole(file, json.dump(2) + "\n");
}

// Writes the figures, even of a run that failed, and prints the summary of a script that met its
// expectations: its name and hash as in tests/equal_hashes.txt. Returns the verdict.
static Status report(const PlayOptions& options, const Statistics& statistics, const Status& verdict) {
    if (!options.stats.empty())
        if (Status written = writeStatistics(options.stats, statistics); !written) return written;
    if (verdict && !statistics.summary.empty()) std::printf("%s\n", statistics.summary.c_str());
    return verdict;
}

// Returns whether a picture is needed. A live video always needs one, because it runs in real time.
static bool isSeen(const PlayOptions& options) {
    const auto address = media::liveAddress(options.environment.video);
    return !options.headless || options.timedemo || !options.screenshot.empty() || !address || *address;
}

// Plays a session without a picture, as fast as possible; reads only the distances of the film.
static Status playUnseen(const PlayOptions& options) {
    SessionConfig config;
    if (Status s = makeSessionConfig(options).moveTo(config); !s) return s;
    const environment::Source source = options.environment.orOwn(dataRoot() / "content" / config.dive.video);
    if (Status s = environment::checkLayer(source); !s) return s;
    const auto usable = source.video.empty() ? media::checkPicture(source.photo + source.env, source.layer)
                        : !options.environment.isOwnVideo() ? media::checkVideo(source.video)
                                                            : Result<std::string>("");
    if (!usable) return usable.error();
    if (Status s = findFilmSpace(source.video, options.environment, config); !s) return s;
    DiveRunner runner(config, options, FrameClock::Mode::FixedStep);
    if (!options.record.empty())
        if (Status s = runner.session.record(options.record); !s) return s;
    do {
        runner.beginFrame({});
        runner.moveMouse(nullptr, {16, 9});
        runner.session.advance(runner.elapsed_s);
    } while (!runner.isOver() && stopSignal == 0);
    Statistics statistics{.renderer = "none"};
    const Status verdict = runner.end(statistics);
    return report(options, statistics, verdict);
}

Status play(const PlayOptions& given) {
    PlayOptions options = given;
    if (!options.file.empty()) environment::setFile(options.environment, options.file);
    if (Status possible = checkOutputsOf(options); !possible) return possible;
    noteStopSignals();
    if (!isSeen(options)) return playUnseen(options);
    Application application(options);
    if (Status opened = application.open(); !opened) {
        if (application.leaving()) return Done{};
        return opened;
    }
    Status verdict = Done{};
    if (options.timedemo) verdict = application.run(false); // to warm up
    if (verdict) verdict = application.run(true);
    // The outputs are written even when an expectation failed: they help to see why.
    if (!options.screenshot.empty() && application.hasPicture())
        if (Status saved = application.saveScreenshot(); !saved) return saved;
    verdict = report(options, application.statistics(), verdict);
    if (options.timedemo) printTimes(application.statistics());
    return verdict;
}

} // namespace shoal::app
