// All texts that the game shows, in each language: the rows of texts.tsv. The English text is the key, as in
// gettext; a key that has no row does not compile. Command line, log and error messages stay English.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace shoal::game {

enum class Language { English, German, French };

using TextRow = std::array<const char*, 3>; // by Language

inline constexpr auto kTexts = std::to_array<TextRow>({
#include "TextRows.inc"
});
static_assert(std::ranges::none_of(kTexts, [](const TextRow& row) { return !row.back(); })); // all languages

// Names that choices have on the command line, and their English on the screen where it differs.
inline constexpr auto kChoiceNames = std::to_array<std::array<std::string_view, 2>>({
    {"auto", "automatic"},
    {"none", "off"},
    {"leap", "Leap Motion"},
    {"snap", "in steps"},
    {"best", "full"},
    {"plain", "sharp"},
    {"resolution", "as sharp as the film"},
    {"camera", "as if filmed"},
    {"sbs", "side by side"},
    {"english", "English"},
    {"german", "Deutsch"},
    {"french", "Français"},
});

// Returns the index of a text's row; kTexts.size() if it has none.
constexpr size_t findText(std::string_view english) {
    size_t row = 0;
    while (row < kTexts.size() && english != kTexts[row][0]) ++row;
    return row;
}

// A text that has a row in kTexts, made from its English words.
class Text {
  public:
    consteval Text(const char* english) : row_(findText(english)) { (void)kTexts.at(row_); }
    constexpr const char* in(Language language) const { return kTexts[row_][static_cast<size_t>(language)]; }
    // The same with values in place of its "{}".
    template <class... Values> std::string in(Language language, const Values&... values) const {
        return fmt::format(fmt::runtime(in(language)), values...);
    }
    constexpr bool operator==(const Text&) const = default;

  private:
    size_t row_;
};

// One message to the player: a text, and the values that replace its "{}". All messages are of this type.
struct Notice {
    Text text;
    std::string value{}, second{}; // names, numbers or files, in place of the first and second "{}"

    std::string in(Language language) const { return text.in(language, value, second); }
    bool operator==(const Notice&) const = default;
};

// Translates a name from a file or table; one without a row stays as it is.
inline std::string_view translated(std::string_view english, Language language) {
    const size_t row = findText(english);
    return row < kTexts.size() ? kTexts[row][static_cast<size_t>(language)] : english;
}

// The same for the value of a setting, by its name on the command line.
inline std::string_view translatedChoice(std::string_view name, Language language) {
    for (const auto& [choice, english] : kChoiceNames)
        if (choice == name) return translated(english, language);
    return translated(name, language);
}

// Returns the language of a locale such as "de_AT.UTF-8" in LC_ALL; English if the game does not have it.
constexpr Language languageOf(std::string_view locale) {
    if (locale.starts_with("de")) return Language::German;
    if (locale.starts_with("fr")) return Language::French;
    return Language::English;
}

} // namespace shoal::game
