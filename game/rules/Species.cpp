#include "game/rules/Species.h"

#include "game/rules/TomlRead.h"

#include <algorithm>

namespace shoal::game {

namespace {

Species readOne(TomlFile& file, const toml::table& entry) {
    TomlTable table(file, entry);
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
    std::string company = kCompanyNames[static_cast<size_t>(s.company)];
    table.text("company", company);
    const auto known = std::find(kCompanyNames.begin(), kCompanyNames.end(), company);
    if (known == kCompanyNames.end())
        table.complain("company", "must be \"alone\", \"pair\" or \"shoal\"");
    else
        s.company = static_cast<Company>(known - kCompanyNames.begin());
    int64_t points = s.shark ? 0 : s.points;
    table.whole("points", points, 0, 1000);
    s.points = static_cast<int>(points);
    table.finish();

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
    auto opened = TomlFile::open(path);
    if (!opened) return opened.error();
    TomlFile& file = *opened;
    TomlTable root(file, file.root());
    root.need("species");
    SpeciesTable species;
    if (const auto* list = root.list("species"))
        for (const toml::node& node : *list) {
            const auto* entry = node.as_table();
            if (!entry) {
                file.complain(&node, "each species must be a table [[species]]");
                break;
            }
            species.push_back(readOne(file, *entry));
            if (findSpecies(species, species.back().name) + 1 != static_cast<int>(species.size()))
                file.complain(entry, "species \"" + species.back().name + "\" occurs twice");
            if (species.size() > 64) file.complain(entry, "more than 64 species");
        }
    root.finish();
    if (species.empty()) file.complain(nullptr, "holds no species");
    if (auto status = file.status(); !status) return status.error();
    return species;
}

} // namespace shoal::game
