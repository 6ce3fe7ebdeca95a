#include "game/settings/KeptFiles.h"

#include "engine/core/JsonBounds.h"
#include "engine/core/Log.h"
#include "engine/core/ThreadPool.h"
#include "engine/core/WriteFile.h"
#include "engine/media/Check.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace shoal::app {

namespace {

using Json = nlohmann::ordered_json;

Path settingsFile() { return configFolder() / "settings.json"; }
// A JSON object of each dive's name to its {"top": [...], "last": ..., "stars": ..., "all_stars": ...}.
Path scoreFile() { return dataFolder() / "scores.json"; }
// A JSON object of "met" to a list of animals, or, from earlier versions, of their names.
Path guideFile() { return dataFolder() / "guide.json"; }

// Returns the JSON object in a file; an empty one if there is no file.
Result<Json> readObject(const Path& file) {
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return Json::object();
    const auto text = readText(file, 1u << 20);
    // Deep nesting would overflow the stack when the file is written again.
    const bool bounded =
        text && exceededBound(*text, {.depth = 16, .values = 100'000, .objects = 10'000}).empty();
    auto json = bounded ? Json::parse(*text, nullptr, false) : Json();
    if (!json.is_object()) return Error{file.string(), "cannot be used; move it away to start anew"};
    return json;
}

// The same; for a file that cannot be used, warns and returns an empty object.
Json readOrWarn(const Path& file) {
    auto json = readObject(file);
    if (json) return std::move(*json);
    log::warn("{}", json.error().message());
    return Json::object();
}

// Returns the entry's score; empty if no dive can have that score.
std::optional<int> scoreIn(const Json& entry) {
    constexpr int kMaxScore = 1'000'000;
    return entry.is_number() ? parseNumber(entry.dump(), -kMaxScore, kMaxScore) : std::nullopt;
}

DiveScores scoresIn(const Json& kept) {
    // Earlier versions kept the best one alone.
    const Json entry = kept.is_object() ? kept : Json::object({{"top", Json::array({kept})}});
    DiveScores scores;
    for (const Json& score : entry.value("top", Json::array()))
        if (const auto value = scoreIn(score); value && scores.top.size() < DiveScores::kKept)
            scores.top.push_back(*value);
    std::ranges::sort(scores.top, std::greater());
    const auto count = [&](const char* key) { return scoreIn(entry.value(key, Json(0))).value_or(0); };
    scores.last = count("last");
    scores.stars = std::max(count("stars"), 0);
    scores.allStars = std::max(count("all_stars"), scores.stars);
    return scores;
}

// Sets one setting from its entry in the file; returns false if it does not fit.
struct ReadEntry {
    const Json& entry;
    const Setting& row;

    template <class Number> bool operator()(Number* value) const {
        return entry.is_number() && numberSetting(*value, row).set(entry.dump());
    }
    bool operator()(bool* value) const { return entry.is_boolean() && (entry.get_to(*value), true); }
    bool operator()(std::string* value) const { return entry.is_string() && (entry.get_to(*value), true); }
    bool operator()(const TextSetting& text) const {
        return entry.is_string() && text.set(entry.get<std::string>());
    }
    bool operator()(std::vector<std::string>*) const { return false; } // no list is a kept setting
};

constexpr size_t kMaxLooked = 5000;              // entries read of each folder
constexpr size_t kMaxRead = 500, kMaxFilms = 60; // files of all folders whose beginning is read; in the list

using Found = std::pair<std::filesystem::file_time_type, Path>; // when the file was changed last

// Returns the newest files of the folders, whatever they are.
std::vector<Found> newestFiles(const std::vector<Path>& folders) {
    std::vector<Found> found;
    std::error_code code;
    for (const Path& folder : folders) {
        size_t looked = 0;
        for (std::filesystem::directory_iterator entry(folder, code), end;
             !code && entry != end && looked < kMaxLooked; entry.increment(code), ++looked)
            if (entry->is_regular_file(code)) found.emplace_back(entry->last_write_time(code), entry->path());
    }
    std::ranges::sort(found, std::ranges::greater(), &Found::first);
    found.resize(std::min(found.size(), kMaxRead));
    return found;
}

struct MakeEntry {
    template <class T> Json operator()(T* value) const { return *value; }
    template <class T> Json operator()(std::optional<T>*) const { return nullptr; }
    Json operator()(const TextSetting& text) const { return text.get(); }
};

} // namespace

void loadSettings(const SettingsTable& table) {
    const Json json = readOrWarn(settingsFile());
    std::string unfit;
    for (const auto& [name, entry] : json.items()) {
        const auto isThis = [&name = name](const Setting& row) { return row.kept && row.key() == name; };
        const auto row = std::ranges::find_if(table.rows, isThis);
        if (row == table.rows.end() || !std::visit(ReadEntry{entry, *row}, row->value))
            unfit += (unfit.empty() ? "" : ", ") + name;
    }
    if (!unfit.empty())
        log::warn(
            "{}: these settings are not known, or their values not possible; they have their defaults: {}",
            settingsFile().string(), unfit);
}

Status saveSetting(const Setting& setting) {
    auto json = readObject(settingsFile());
    if (!json) return json.error();
    (*json)[setting.key()] = std::visit(MakeEntry(), setting.value);
    return writeFileWhole(settingsFile(), json->dump(2) + "\n");
}

std::map<std::string, DiveScores> readScores() {
    std::map<std::string, DiveScores> scores;
    const Json all = readOrWarn(scoreFile());
    for (const auto& [dive, entry] : all.items()) scores.emplace(dive, scoresIn(entry));
    return scores;
}

int starsIn(const std::map<std::string, DiveScores>& scores) {
    int stars = 0;
    for (const auto& [dive, own] : scores) stars += own.allStars;
    return stars;
}

Status addScore(const std::string& dive, int score, int stars) {
    auto all = readObject(scoreFile());
    if (!all) return all.error();
    const DiveScores before = scoresIn((*all)[dive]);
    std::vector<int> top = before.top;
    if (score > 0) top.insert(std::ranges::upper_bound(top, score, std::greater()), score);
    top.resize(std::min(top.size(), DiveScores::kKept));
    (*all)[dive] = {{"top", top},
                    {"last", score},
                    {"stars", std::max(before.stars, stars)},
                    {"all_stars", before.allStars + stars}};
    return writeFileWhole(scoreFile(), all->dump(2) + "\n");
}

std::vector<MetAnimal> readGuide() {
    std::vector<MetAnimal> met;
    const Json guide = readOrWarn(guideFile());
    for (const Json& kept : guide.value("met", Json::array())) {
        const Json entry = kept.is_object() ? kept : Json::object({{"species", kept}});
        const auto text = [&](const char* key) {
            const Json value = entry.value(key, Json());
            return value.is_string() ? value.get<std::string>() : "";
        };
        MetAnimal animal{.species = text("species"),
                         .caught = std::max(scoreIn(entry.value("caught", Json(0))).value_or(0), 0),
                         .dive = text("dive"),
                         .date = text("date")};
        const Json largest = entry.value("largest_m", Json());
        if (largest.is_number()) animal.largest_m = std::clamp(largest.get<float>(), 0.0f, 30.0f);
        if (!animal.species.empty()) met.push_back(std::move(animal));
    }
    return met;
}

Status saveGuide(const std::vector<MetAnimal>& met) {
    auto guide = readObject(guideFile());
    if (!guide) return guide.error();
    Json& list = (*guide)["met"] = Json::array();
    for (const MetAnimal& animal : met)
        list.push_back({{"species", animal.species},
                        {"caught", animal.caught},
                        {"largest_m", animal.largest_m},
                        {"dive", animal.dive},
                        {"date", animal.date}});
    return writeFileWhole(guideFile(), guide->dump(2) + "\n");
}

void FilmList::look() {
    thread_ = {}; // ends the last one
    folders_ = {userFolder(UserFolder::Videos), userFolder(UserFolder::Pictures),
                userFolder(UserFolder::Downloads)};
    thread_ = std::jthread([this](const std::stop_token& ending) { read(ending); });
}

FilmList::Found FilmList::found() const {
    const std::lock_guard lock(mutex_);
    return found_;
}

void FilmList::read(const std::stop_token& ending) {
    lowerThreadPriority();
    std::vector<Path> files;
    for (const auto& [changed, file] : newestFiles(folders_)) {
        if (ending.stop_requested()) return;
        if (files.size() == kMaxFilms) break;
        const auto kind = media::mediaKind(file);
        if (!kind || *kind == media::MediaKind::DepthTrack) continue;
        files.push_back(file);
        const std::lock_guard lock(mutex_);
        if (files.size() > found_.files.size()) found_.files = files;
    }
    const std::lock_guard lock(mutex_);
    found_ = {std::move(files), true};
}

} // namespace shoal::app
