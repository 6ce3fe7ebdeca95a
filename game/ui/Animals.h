// The animals' names on the screen.
#pragma once

#include "game/rules/DiveFile.h"
#include "game/texts/Texts.h"

namespace shoal::game {

// Returns the text in the language, in English where it is missing there.
inline const std::string& textIn(const InLanguages& text, Language language) {
    const std::string& words = text[static_cast<size_t>(language)];
    return words.empty() ? text[0] : words;
}

inline const std::string& animalName(const Species& animal, int count, Language language) {
    const std::string& name = textIn(count == 1 ? animal.one : animal.several, language);
    return name.empty() ? animal.name : name;
}

} // namespace shoal::game
