#include "game/app/Settings.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"

#include <nlohmann/json.hpp>

namespace shoal::app {

namespace {

Path settingsFile() { return configFolder() / "settings.json"; }

void readShare(const nlohmann::json& json, const char* name, float& value) {
    const auto entry = json.find(name);
    if (entry == json.end() || !entry->is_number()) return;
    const float given = entry->get<float>();
    if (given >= 0 && given <= 1) value = given;
}

void readSwitch(const nlohmann::json& json, const char* name, bool& value) {
    const auto entry = json.find(name);
    if (entry != json.end() && entry->is_boolean()) value = entry->get<bool>();
}

} // namespace

Settings loadSettings() {
    Settings settings;
    std::error_code code;
    if (!std::filesystem::exists(settingsFile(), code)) return settings;
    const auto text = readText(settingsFile(), 1u << 20);
    const auto json = text ? nlohmann::json::parse(*text, nullptr, false) : nlohmann::json();
    if (!json.is_object()) {
        log::warn("{}: cannot be used; move it away to start anew", settingsFile().string());
        return settings;
    }
    readShare(json, "volume", settings.volume);
    readShare(json, "haptics", settings.hapticStrength);
    readSwitch(json, "headphones", settings.headphones);
    readSwitch(json, "captions", settings.captions);
    readSwitch(json, "snow", settings.snow);
    return settings;
}

Status saveSettings(const Settings& settings) {
    const nlohmann::ordered_json json = {{"volume", settings.volume},
                                         {"haptics", settings.hapticStrength},
                                         {"headphones", settings.headphones},
                                         {"captions", settings.captions},
                                         {"snow", settings.snow}};
    return writeFileWhole(settingsFile(), json.dump(2) + "\n");
}

} // namespace shoal::app
