#include "game/app/Play.h"

#include "engine/core/Log.h"
#include "game/app/Application.h"
#include "game/settings/SettingsFile.h"

#include <cstdio>

namespace shoal::app {

namespace {

// What the player has changed by keys, into the settings file.
void keepChanges(const PlayOptions& before, const PlayOptions& after) {
    if (after.volume == before.volume && after.fullscreen == before.fullscreen &&
        after.frameTimes == before.frameTimes)
        return;
    PlayOptions kept;
    const SettingsTable table = kept.settings();
    loadSettings(table);
    if (after.volume != before.volume) kept.volume = after.volume;
    if (after.fullscreen != before.fullscreen) kept.fullscreen = after.fullscreen;
    if (after.frameTimes != before.frameTimes) kept.frameTimes = after.frameTimes;
    if (Status saved = saveSettings(table); !saved) log::warn("{}", saved.error().message());
}

void printTimes(const Statistics& statistics, bool live) {
    std::printf("%s: %zu frames, median %.2f ms, 99th percentile %.2f ms, worst %.2f ms\n",
                statistics.renderer.c_str(), statistics.frame_ms.count(), statistics.frame_ms.quantile(0.5),
                statistics.frame_ms.quantile(0.99), statistics.frame_ms.quantile(1));
    if (live) std::printf("%s\n", describe(statistics.live).c_str());
}

Status run(const PlayOptions& options) {
    Application application(options);
    if (Status opened = application.open(); !opened) return opened;
    Status verdict = Done{};
    if (options.timedemo) verdict = application.runSession(false); // to warm up
    if (verdict) verdict = application.runSession(true);
    if (!options.headless) keepChanges(options, application.options());
    // What was asked for is written even when an expectation failed: it helps to see why.
    if (!options.screenshot.empty() && application.hasPicture())
        if (Status saved = application.saveScreenshot(); !saved) return saved;
    if (!options.stats.empty())
        if (Status written = writeStatistics(options.stats, application.statistics()); !written)
            return written;
    if (options.timedemo) printTimes(application.statistics(), application.showsLiveVideo());
    return verdict;
}

} // namespace

int play(const PlayOptions& options) {
    const Status status = run(options);
    if (status) return 0;
    log::error("{}", status.error().message());
    return 1;
}

} // namespace shoal::app
