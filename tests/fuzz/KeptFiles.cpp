// The player's own files: settings, scores and guide. Reading any, and writing into any.
#include "game/settings/KeptFiles.h"
#include "game/settings/PlayOptions.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput settings("settings.json"), scores("scores.json"), guide("guide.json");
    if (size == 0) return 0;
    const std::span<const uint8_t> bytes(data + 1, size - 1);
    const auto here = [](const fuzz::FileInput& file) {
        ::setenv("XDG_CONFIG_HOME", file.folder().c_str(), 1);
        ::setenv("XDG_DATA_HOME", file.folder().c_str(), 1);
    };
    app::PlayOptions options;
    const app::SettingsTable table = app::settingsOf(options);
    switch (data[0] % 3) {
    case 0:
        here(settings), settings(bytes);
        app::loadSettings(table);
        for (const app::Setting& row : table.rows)
            if (row.kept) {
                (void)app::saveSetting(row);
                break;
            }
        break;
    case 1:
        here(scores), scores(bytes);
        fuzz::expect(app::readScores()["reef"].top.size() <= app::DiveScores::kKept);
        if (app::addScore("reef", 40)) fuzz::expect(app::readScores()["reef"].last == 40);
        break;
    default:
        here(guide), guide(bytes);
        (void)app::saveGuide(app::readGuide());
    }
    return 0;
}
