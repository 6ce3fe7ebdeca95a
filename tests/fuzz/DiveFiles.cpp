// A table of species and a dive that uses it: two texts, one behind the other, parted by a line of dashes.
#include "game/rules/Dive.h"
#include "tests/fuzz/Target.h"

#include <cmath>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput speciesFile("species.toml"), diveFile("input.toml");
    constexpr std::string_view kBetween = "\n---\n";
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const size_t at = text.find(kBetween);
    if (at == text.npos) return 0;
    const auto species = game::loadSpecies(speciesFile({data, at}));
    if (!species) return 0;
    const size_t rest = at + kBetween.size();
    const auto dive = game::loadDive(diveFile({data + rest, size - rest}), *species);
    if (!dive) return 0;
    // A dive that the loader takes can be played.
    game::Dive played(*species, *dive, 1);
    game::Events events;
    for (int tick = 0; tick < 3; ++tick) played.step({}, events);
    for (const game::Fish& fish : played.state().fish) fuzz::expect(std::isfinite(fish.position.x));
    return 0;
}
