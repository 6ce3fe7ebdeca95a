#include "game/settings/EditSetting.h"

#include <fmt/core.h>

#include <cmath>

namespace shoal::app {

namespace {

// Numbers in ranges up to this are shares or factors, shown as percent.
constexpr double kPercentRange = 3;

double stepOf(const Setting::Range& range) { return range.high - range.low <= kPercentRange ? 0.05 : 5; }

// Rounds a number to a multiple of its step, or to an end of its range.
double rounded(double value, const Setting::Range& range) {
    const double step = stepOf(range);
    return std::clamp(std::round(value / step) * step, range.low, range.high);
}

struct GetText {
    const Setting& row;
    std::string operator()(bool* value) const { return *value ? "on" : "off"; }
    std::string operator()(std::string* value) const {
        return value->empty() && !row.suggestions.empty() ? row.suggestions[0] : *value;
    }
    std::string operator()(const TextSetting& text) const { return text.get ? text.get() : ""; }
    template <class Other> std::string operator()(Other*) const { return ""; }
    template <class Number>
    requires std::is_arithmetic_v<Number> std::string operator()(Number* value) const {
        const auto number = static_cast<double>(*value);
        if (row.range && row.range->high <= kPercentRange)
            return fmt::format("{} %", std::lround(100 * number));
        return fmt::format("{}", std::lround(number));
    }
};

struct Adjust {
    const Setting& row;
    int steps;
    void operator()(bool* value) const { *value = (steps % 2 != 0) != *value; }
    void operator()(std::string* value) const { *value = next(row.suggestions, GetText{row}(value)); }
    void operator()(const TextSetting& text) const { text.set(next(text.names, text.get())); }
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void operator()(Number* value) const {
        if (row.range)
            *value = static_cast<Number>(
                rounded(static_cast<double>(*value) + steps * stepOf(*row.range), *row.range));
    }
    template <class Other> void operator()(Other*) const {}

    std::string next(const std::vector<std::string>& names, const std::string& now) const {
        if (names.empty()) return now;
        const auto count = static_cast<int>(names.size());
        const auto at = static_cast<int>(std::ranges::find(names, now) - names.begin());
        return names[static_cast<size_t>(((at + steps) % count + count) % count)];
    }
};

} // namespace

std::string shownValue(const Setting& setting, game::Language language) {
    return std::string(game::translated(std::visit(GetText{setting}, setting.value), language));
}

std::optional<float> sliderOf(const Setting& setting) {
    if (!setting.range) return std::nullopt;
    const auto* number = std::get_if<float*>(&setting.value);
    if (!number) return std::nullopt;
    const auto [low, high] = *setting.range;
    return static_cast<float>((static_cast<double>(**number) - low) / (high - low));
}

void adjust(const Setting& setting, int steps) { std::visit(Adjust{setting, steps}, setting.value); }

void slide(const Setting& setting, float fraction) {
    if (!sliderOf(setting) || !isWithin(fraction, 0.0f, 1.0f)) return;
    const Setting::Range& range = *setting.range;
    *std::get<float*>(setting.value) = static_cast<float>(
        rounded(range.low + static_cast<double>(fraction) * (range.high - range.low), range));
}

} // namespace shoal::app
