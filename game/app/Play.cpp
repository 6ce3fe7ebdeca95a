#include "engine/core/Log.h"
#include "game/app/Application.h"
#include "game/settings/SettingsFile.h"
#include "game/tools/Commands.h"

namespace shoal::app {

namespace {

// What the player has changed by keys, into the settings file.
void keepChanges(const PlayOptions& before, const PlayOptions& after) {
    if (after.volume == before.volume && after.fullscreen == before.fullscreen &&
        after.frameTimes == before.frameTimes)
        return;
    PlayOptions kept;
    const SettingsTable table = settingsOf(kept);
    loadSettings(table);
    if (after.volume != before.volume) kept.volume = after.volume;
    if (after.fullscreen != before.fullscreen) kept.fullscreen = after.fullscreen;
    if (after.frameTimes != before.frameTimes) kept.frameTimes = after.frameTimes;
    if (Status saved = saveSettings(table); !saved) log::warn("{}", saved.error().message());
}

} // namespace

Status play(const PlayOptions& options) {
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

} // namespace shoal::app
