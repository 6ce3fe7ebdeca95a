// The animals' names on the screen, by their names in content/species.toml.
#pragma once

#include "game/texts/Texts.h"

#include <algorithm>

namespace shoal::game {

struct AnimalRow {
    std::string_view species;
    TextRow one, several;
};
inline constexpr auto kAnimals = std::to_array<AnimalRow>({
    {"clownfish",
     {"clownfish", "Clownfisch", "poisson-clown"},
     {"clownfish", "Clownfische", "poissons-clowns"}},
    {"angelfish",
     {"angelfish", "Kaiserfisch", "poisson-ange"},
     {"angelfish", "Kaiserfische", "poissons-anges"}},
    {"snapper", {"snapper", "Schnapper", "vivaneau"}, {"snappers", "Schnapper", "vivaneaux"}},
    {"sardine", {"sardine", "Sardine", "sardine"}, {"sardines", "Sardinen", "sardines"}},
    {"boxfish",
     {"boxfish", "Kofferfisch", "poisson-coffre"},
     {"boxfish", "Kofferfische", "poissons-coffres"}},
    {"idol",
     {"Moorish idol", "Halfterfisch", "idole maure"},
     {"Moorish idols", "Halfterfische", "idoles maures"}},
    {"ray", {"ray", "Rochen", "raie"}, {"rays", "Rochen", "raies"}},
    {"shark", {"shark", "Hai", "requin"}, {"sharks", "Haie", "requins"}},
    {"jellyfish", {"jellyfish", "Qualle", "méduse"}, {"jellyfish", "Quallen", "méduses"}},
    {"whale", {"whale", "Wal", "baleine"}, {"whales", "Wale", "baleines"}},
});

// Returns the animal's name; a species without a row keeps its own.
inline std::string animalName(std::string_view species, int count, Language language) {
    const auto row = std::ranges::find(kAnimals, species, &AnimalRow::species);
    if (row == kAnimals.end()) return std::string(species);
    return textIn(count == 1 ? row->one : row->several, language);
}

} // namespace shoal::game
