#include "game/rules/Species.h"

#include "game/rules/TomlRead.h"

namespace shoal::game {

namespace {

Species readOne(TomlTable& table) {
    Species s;
    table.need("name");
    table.need("model");
    table.need("length");
    table.text("name", s.name);
    table.text("model", s.model);
    table.flag("shark", s.shark);
    table.number("length", s.length_m, 0.03f, 5);
    table.number("body_radius", s.bodyRadius_m, 0.01f, 0.6f);
    table.number("body_half", s.bodyHalf_m, 0, 2);
    table.number("cruise", s.cruise_mps, 0.05f, 2);
    table.number("dart", s.dart_mps, 0.1f, kMaxSpeed_mps);
    table.number("turn", s.turn_radps, 0.2f, 10);
    table.number("shyness", s.shyness, 0, 3);
    table.number("spacing", s.spacing, 0.6f, 5);
    table.number("stride", s.stride, 0.2f, 1.5f);
    table.flag("coasts", s.coasts);
    if (const auto company = table.choice("company", kCompanyNames))
        s.company = static_cast<Company>(*company);
    if (s.shark) s.points = 0;
    table.whole("points", s.points, 0, 1000);
    if (s.name.empty()) table.complain("name", "must not be empty");
    if (s.model.find("..") != std::string::npos || s.model.starts_with('/'))
        table.complain("model", "must name a file below content/");
    if (s.dart_mps < s.cruise_mps) table.complain("dart", "must not be slower than \"cruise\"");
    if (2 * (s.bodyHalf_m + s.bodyRadius_m) > 1.1f * s.length_m)
        table.complain("body_half", "makes the body longer than \"length\"");
    return s;
}

} // namespace

int findSpecies(const SpeciesTable& table, std::string_view name) {
    for (size_t i = 0; i < table.size(); ++i)
        if (table[i].name == name) return static_cast<int>(i);
    return -1;
}

Result<SpeciesTable> loadSpecies(const Path& path) {
    SpeciesTable species;
    const Status read = readToml(path, [&](TomlTable& root) {
        root.need("species");
        root.tables("species", 64, [&](TomlTable& table) {
            species.push_back(readOne(table));
            if (findSpecies(species, species.back().name) + 1 != static_cast<int>(species.size()))
                table.complain("species", "occurs twice: \"" + species.back().name + "\"");
        });
        if (species.empty()) root.complain("species", "holds no species");
    });
    if (!read) return read.error();
    return species;
}

} // namespace shoal::game
