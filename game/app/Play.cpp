// The command `play`: plays a dive, with a picture or without.
#include "engine/core/WriteFile.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"
#include "game/app/Application.h"
#include "game/tools/Commands.h"

#include <array>

namespace shoal::app {

// Makes these signals set stopSignal from now on; a second one of a kind ends the program at once.
static void noteStopSignals() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { stopSignal = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // nohup has them ignored
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

// Writes the figures, even of a run that failed, and prints the summary of a script that met its
// expectations: its name and hash as in tests/equal_hashes.txt. Returns the verdict.
static Status report(const PlayOptions& options, const Statistics& statistics, const std::string& summary,
                     const Status& verdict) {
    if (!options.stats.empty())
        if (Status written = writeStatistics(options.stats, statistics); !written) return written;
    if (verdict && !summary.empty()) std::printf("%s\n", summary.c_str());
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
    const EnvironmentOptions& environment = options.environment;
    const Path film =
        environment.video.empty() ? dataRoot() / "content" / config.dive.video : Path(environment.video);
    const bool still = !environment.photo.empty() || !environment.env.empty();
    const auto usable = still ? media::checkPicture(environment.photo + environment.env, environment.layer)
                        : !environment.isOwnVideo() ? media::checkVideo(film)
                                                    : Result<std::string>("");
    if (!usable) return usable.error();
    if (Status s = findFilmSpace(still ? Path() : film, environment, config); !s) return s;
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
    return report(options, statistics, runner.session.summary, verdict);
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
    verdict = report(options, application.statistics(), application.summary(), verdict);
    if (options.timedemo) printTimes(application.statistics(), application.showsLiveVideo());
    return verdict;
}

} // namespace shoal::app
