#include "game/settings/KeptFiles.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"

#include <nlohmann/json.hpp>

namespace shoal::app {

namespace {

using Json = nlohmann::ordered_json;

Path settingsFile() { return configFolder() / "settings.json"; }
Path scoreFile() { return scoreFolder() / "scores.json"; } // an object of dive name to score

// The object in a file; empty where there is no file.
Result<Json> readObject(const Path& file) {
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return Json::object();
    const auto text = readText(file, 1u << 20);
    auto json = text ? Json::parse(*text, nullptr, false) : Json();
    if (!json.is_object()) return Error{file.string(), "cannot be used; move it away to start anew"};
    return json;
}

// Sets one setting from its entry in the file, where that fits.
struct ReadEntry {
    const Json& entry;
    const Setting& row;

    template <class Number>
    requires std::is_arithmetic_v<Number>
    void operator()(Number* value) const {
        if (!entry.is_number()) return;
        const double given = entry.get<double>();
        if (row.range && given >= row.range->low && given <= row.range->high)
            *value = static_cast<Number>(given);
    }
    void operator()(bool* value) const {
        if (entry.is_boolean()) *value = entry.get<bool>();
    }
    void operator()(std::string* value) const {
        if (entry.is_string()) *value = entry.get<std::string>();
    }
    void operator()(const TextSetting& text) const {
        if (entry.is_string()) text.set(entry.get<std::string>());
    }
    template <class Other> void operator()(Other*) const {} // lists and optional values are not kept
};

struct MakeEntry {
    template <class T> Json operator()(T* value) const { return *value; }
    template <class T> Json operator()(std::optional<T>*) const { return nullptr; }
    Json operator()(const TextSetting& text) const { return text.get(); }
};

} // namespace

void loadSettings(const SettingsTable& table) {
    const auto json = readObject(settingsFile());
    if (!json) return log::warn("{}", json.error().message());
    for (const Setting& row : table.rows) {
        const auto entry = json->find(row.key());
        if (row.kept && entry != json->end()) std::visit(ReadEntry{*entry, row}, row.value);
    }
}

Status saveSettings(const SettingsTable& table) {
    Json json = Json::object();
    for (const Setting& row : table.rows)
        if (row.kept) json[row.key()] = std::visit(MakeEntry(), row.value);
    return writeFileWhole(settingsFile(), json.dump(2) + "\n");
}

int bestScore(const std::string& dive) {
    const auto scores = readObject(scoreFile());
    if (!scores) {
        log::warn("{}", scores.error().message());
        return 0;
    }
    const auto entry = scores->find(dive);
    return entry != scores->end() && entry->is_number_integer() ? entry->get<int>() : 0;
}

Status saveBestScore(const std::string& dive, int score) {
    auto scores = readObject(scoreFile());
    if (!scores) return scores.error();
    (*scores)[dive] = score;
    return writeFileWhole(scoreFile(), scores->dump(2) + "\n");
}

} // namespace shoal::app
