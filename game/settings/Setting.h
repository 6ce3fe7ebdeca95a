// Rows of the table of settings. The command line, its --help and the settings file are generated from them.
// A row points into a struct of options, which must outlive it.
#pragma once

#include "engine/core/EnumNames.h"
#include "engine/core/Number.h"
#include "game/texts/Texts.h"

#include <fmt/core.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace shoal::app {

enum class Category { General, Dive, Environment, Picture, Hands, Sound, Measuring };

enum class SettingsPage { None, Hands, Comfort, Picture, Sound, Text };

// A setting that is text: one of a few names, or in a notation of its own.
struct TextSetting {
    std::function<bool(const std::string& text)> set; // false, and no change, if the text is malformed
    std::string wants;                                // says what is accepted: "wants ..."
    std::function<std::string()> get;                 // returns the value, for a kept setting
    std::vector<std::string> names{};                 // all names, if the text must be one of them
};

// Makes the setting of an enumeration. values: those allowed, empty: all.
template <class E> TextSetting choice(E& value, const std::vector<E>& values = {}) {
    const auto& all = kEnumNames<E>;
    std::vector<std::string> names;
    for (const E allowed : values) names.emplace_back(enumName(allowed));
    if (names.empty()) names.assign(all.begin(), all.end());
    const auto set = [&value, names](const std::string& name) {
        if (std::ranges::find(names, name) == names.end()) return false;
        value = *enumNamed<E>(name);
        return true;
    };
    return {set, "", [&value] { return std::string(enumName(value)); }, names};
}

TextSetting sizeSetting(glm::ivec2& pixels);                   // WIDTHxHEIGHT
TextSetting addressSetting(std::string& host, uint16_t& port); // HOST:PORT or [IPV6]:PORT
TextSetting vectorSetting(std::optional<glm::vec3>& value);    // X,Y,Z
// Different numbers with commas between; `values` has them in ascending order.
TextSetting listSetting(std::vector<float>& values, float low, float high);

struct SettingTraits { // what only some settings have
    struct Range {
        double low = 0, high = 0; // both included; equal: no limits
        bool given() const { return low < high; }
    };

    Range range{};             // of a number
    std::string placeholder{}; // name of the option's value in --help
    bool required = false;
    bool personal = false;                        // applies to a person's dive, not to a script or replay
    std::vector<std::string> excludes{}, needs{}; // other options
    std::vector<std::string> suggestions{};       // values that the menu page offers for a free text
};

struct Setting : SettingTraits {
    using Value = std::variant<bool*, int*, float*, std::string*, std::vector<std::string>*,
                               std::optional<float>*, std::optional<uint64_t>*, TextSetting>;

    std::string option; // "--name"; "!--no-name": a flag that turns `name` off; "NAME": a positional argument
    Value value;
    std::string help; // with the unit, if there is one
    Category category = Category::General;
    bool kept = false; // kept in the settings file
    // The menu page that shows the setting. A number is a slider there, so it needs a range.
    SettingsPage page = SettingsPage::None;
    std::optional<game::Text> label{};

    std::string key() const; // name in the settings file: the option's, without dashes and "no"
};

// Makes the setting of a number, or of an optional one, within the row's range or that of its type.
template <class Value> TextSetting numberSetting(Value& value, const Setting& row) {
    using T = typename decltype(std::optional(value))::value_type;
    const T low = row.range.given() ? static_cast<T>(row.range.low) : std::numeric_limits<T>::lowest();
    const T high = row.range.given() ? static_cast<T>(row.range.high) : std::numeric_limits<T>::max();
    const auto set = [&value, low, high](const std::string& text) {
        const auto number = parseNumber(text, low, high);
        return number && (value = *number, true);
    };
    const char* whole = std::is_integral_v<T> ? "whole " : "";
    return {set, fmt::format("wants a {}number from {} to {}", whole, low, high), {}};
}

// Returns the value in the language of the screen; numbers as percent where that says more.
std::string shownValue(const Setting& setting, game::Language language);

// Returns a number's place in its range, 0 to 1; empty: the setting is a choice.
std::optional<float> sliderOf(const Setting& setting);

// Moves to the next value, or by several steps; choices wrap around.
void adjust(const Setting& setting, int steps);
void slide(const Setting& setting, float fraction);

struct SettingsTable {
    std::vector<Setting> rows;
    Category category = Category::General; // category of the rows added next

    void add(std::string option, Setting::Value value, std::string help, SettingTraits traits = {}) {
        rows.push_back({std::move(traits), std::move(option), std::move(value), std::move(help), category});
    }
    // Adds a setting that belongs in the settings file.
    void addKept(std::string option, Setting::Value value, std::string help, SettingTraits traits = {}) {
        add(std::move(option), std::move(value), std::move(help), std::move(traits));
        rows.back().kept = true;
    }
    // The same, and on a menu page.
    void addShown(SettingsPage page, game::Text label, std::string option, Setting::Value value,
                  std::string help, SettingTraits traits = {}) {
        addKept(std::move(option), std::move(value), std::move(help), std::move(traits));
        rows.back().page = page;
        rows.back().label = label;
    }
};

template <class Options> SettingsTable settingsOf(Options& options) {
    SettingsTable table;
    options.addTo(table);
    return table;
}

} // namespace shoal::app

template <>
inline constexpr std::array shoal::kEnumNames<shoal::app::Category> = {
    "Options", "The dive", "The environment", "Picture", "Hands and haptics", "Sound", "Tests and figures"};
