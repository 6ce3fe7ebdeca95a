#include "game/settings/Setting.h"

#include <cmath>
#include <ranges>
#include <set>

namespace shoal::app {

// Sets a vector from kCount numbers with a character between them, or changes nothing and returns false.
template <int kCount, class Vector, class T>
static bool setVector(Vector& value, std::string_view text, char between, T low, T high) {
    glm::vec<kCount, T> read(0);
    for (int i = 0; i < kCount; ++i) {
        const size_t end = i + 1 < kCount ? text.find(between) : text.size();
        const auto number = parseNumber(text.substr(0, end), low, high);
        if (!number || end > text.size()) return false;
        read[i] = *number;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    value = read;
    return true;
}

// Numbers with at most this upper limit are shares or factors, which are shown as percent.
constexpr double kPercentRange = 3;

static double stepOf(const Setting::Range& range) {
    return range.high - range.low <= kPercentRange ? 0.05 : 5;
}

// Rounds a number to a multiple of its step, or to an end of its range.
static double rounded(double value, const Setting::Range& range) {
    const double step = stepOf(range);
    return std::clamp(std::round(value / step) * step, range.low, range.high);
}

// Returns the value as text, and all values that the menus offer, which is none for a number.
static std::pair<std::string, std::vector<std::string>> choicesOf(const Setting& setting) {
    if (const auto* flag = std::get_if<bool*>(&setting.value)) return {**flag ? "on" : "off", {"off", "on"}};
    if (const auto* text = std::get_if<TextSetting>(&setting.value))
        return {text->get ? text->get() : "", text->names};
    const auto* text = std::get_if<std::string*>(&setting.value);
    if (!text) return {};
    const auto& some = setting.suggestions;
    return {(*text)->empty() && !some.empty() ? some[0] : **text, some};
}

TextSetting sizeSetting(glm::ivec2& pixels) {
    const auto set = [&](const std::string& text) { return setVector<2>(pixels, text, 'x', 16, 8192); };
    return {set, "wants WIDTHxHEIGHT in pixels, 16x16 to 8192x8192", {}};
}

TextSetting addressSetting(std::string& host, uint16_t& port) {
    const auto set = [&host, &port](const std::string& text) {
        const size_t colon = text.rfind(':');
        const auto number = parseNumber<uint16_t>(text.substr(colon + 1), 1);
        if (!number || colon == std::string::npos || colon == 0) return false;
        const bool isBracketed = text[0] == '[' && text[colon - 1] == ']' && colon > 2;
        if (!isBracketed && text.find_first_of("[]:") != colon) return false;
        host = text.substr(0, colon);
        port = *number;
        return true;
    };
    return {set, "wants HOST:PORT, or [IPV6]:PORT",
            [&host, &port] { return host + ":" + std::to_string(port); }};
}

TextSetting vectorSetting(std::optional<glm::vec3>& value) {
    const auto set = [&](const std::string& text) { return setVector<3>(value, text, ',', -1e6f, 1e6f); };
    return {set, "wants three numbers from -1000000 to 1000000 with commas between", {}};
}

TextSetting listSetting(std::vector<float>& values, float low, float high) {
    const auto set = [&values, low, high](const std::string& text) {
        std::set<float> read;
        for (const auto part : std::views::split(text, ',')) {
            const auto number = parseNumber(std::string_view(part.begin(), part.end()), low, high);
            if (!number || !read.insert(*number).second) return false;
        }
        values.assign(read.begin(), read.end());
        return !values.empty();
    };
    return {set, fmt::format("wants different numbers from {} to {} with commas between", low, high), {}};
}

std::string Setting::key() const {
    for (const char* prefix : {"!--no-", "--"})
        if (option.starts_with(prefix)) return option.substr(std::string(prefix).size());
    return option;
}

std::string shownValue(const Setting& setting, game::Language language) {
    const auto* number = std::get_if<float*>(&setting.value);
    if (!number) return std::string(game::translatedChoice(choicesOf(setting).first, language));
    if (setting.range.given() && setting.range.high <= kPercentRange)
        return fmt::format("{} %", std::lround(100 * **number));
    return fmt::format("{}", std::lround(**number));
}

std::optional<float> sliderOf(const Setting& setting) {
    const auto* number = std::get_if<float*>(&setting.value);
    if (!number || !setting.range.given()) return std::nullopt;
    const auto [low, high] = setting.range;
    return static_cast<float>((static_cast<double>(**number) - low) / (high - low));
}

void adjust(const Setting& setting, int steps) {
    const auto* number = std::get_if<float*>(&setting.value);
    if (number && setting.range.given())
        **number = static_cast<float>(
            rounded(static_cast<double>(**number) + steps * stepOf(setting.range), setting.range));
    const auto [now, names] = choicesOf(setting);
    if (names.empty()) return;
    const auto count = static_cast<int>(names.size());
    const auto at = static_cast<int>(std::ranges::find(names, now) - names.begin());
    const std::string& next = names[((at + steps) % count + count) % count];
    if (const auto* flag = std::get_if<bool*>(&setting.value)) **flag = next == "on";
    if (const auto* text = std::get_if<std::string*>(&setting.value)) **text = next;
    if (const auto* text = std::get_if<TextSetting>(&setting.value)) text->set(next);
}

void slide(const Setting& setting, float fraction) {
    if (!sliderOf(setting) || !isWithin(fraction, 0.0f, 1.0f)) return;
    const Setting::Range& range = setting.range;
    *std::get<float*>(setting.value) = static_cast<float>(
        rounded(range.low + static_cast<double>(fraction) * (range.high - range.low), range));
}

} // namespace shoal::app
