#include "game/session/Scores.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"

#include <nlohmann/json.hpp>

namespace shoal::app {

namespace {

Path scoreFile() { return scoreFolder() / "scores.json"; }

// An object of dive name to score. Missing: empty. Unusable: an error.
Result<nlohmann::json> readScores() {
    std::error_code code;
    if (!std::filesystem::exists(scoreFile(), code)) return nlohmann::json::object();
    auto text = readText(scoreFile(), 1u << 20);
    if (!text) return text.error();
    auto json = nlohmann::json::parse(*text, nullptr, false);
    if (!json.is_object())
        return Error{scoreFile().string(), "is not a list of scores; move it away to start anew"};
    return json;
}

} // namespace

int bestScore(const std::string& dive) {
    auto scores = readScores();
    if (!scores) {
        log::warn("{}", scores.error().message());
        return 0;
    }
    const auto entry = scores->find(dive);
    return entry != scores->end() && entry->is_number_integer() ? entry->get<int>() : 0;
}

Status saveBestScore(const std::string& dive, int score) {
    auto scores = readScores();
    if (!scores) return scores.error();
    (*scores)[dive] = score;
    return writeFileWhole(scoreFile(), scores->dump(2) + "\n");
}

} // namespace shoal::app
