#include "game/DiveFile.h"

#include "game/TomlRead.h"

namespace shoal::game {

namespace {

constexpr int kMaxFish = 1000;
constexpr size_t kMaxVisits = 100;
constexpr size_t kMaxShelters = 100;

int speciesNamed(TomlTable& table, const SpeciesTable& known, bool shark) {
    std::string name;
    table.need("species");
    table.text("species", name);
    const int index = findSpecies(known, name);
    if (index < 0)
        table.complain("species", "is not known: \"" + name + "\"");
    else if (known[index].shark != shark)
        table.complain("species", shark ? "must be a shark" : "must not be a shark");
    return index;
}

School readSchool(TomlFile& file, const toml::table& entry, const SpeciesTable& known) {
    TomlTable table(file, entry);
    School school;
    school.species = speciesNamed(table, known, false);
    int64_t count = school.count;
    table.need("count");
    table.whole("count", count, 1, kMaxFish);
    school.count = static_cast<int>(count);
    table.range("radius", school.radiusLow_m, school.radiusHigh_m, 0.6f, 6);
    table.range("height", school.heightLow_m, school.heightHigh_m, -2, 2);
    table.finish();
    return school;
}

SharkPlan readShark(TomlFile& file, const toml::table& entry, const SpeciesTable& known) {
    TomlTable table(file, entry);
    SharkPlan shark;
    shark.species = speciesNamed(table, known, true);
    table.number("radius", shark.radius_m, 3, 8);
    table.number("height", shark.height_m, -1, 1);
    table.number("visit_length", shark.visitLength_s, 1, 60);
    table.number("prowl_radius", shark.prowlRadius_m, 1.1f, 3);
    if (const auto* visits = table.list("visits")) {
        if (visits->size() > kMaxVisits) table.complain("visits", "holds more than 100 times");
        for (const toml::node& node : *visits) {
            const float at = static_cast<float>(node.value<double>().value_or(-1));
            if (!(at >= 0 && at <= 3600) || (!shark.visits_s.empty() && at <= shark.visits_s.back())) {
                table.complain("visits", "must be rising times in seconds");
                break;
            }
            shark.visits_s.push_back(at);
        }
    }
    table.finish();
    return shark;
}

Shelter readShelter(TomlFile& file, const toml::table& entry) {
    TomlTable table(file, entry);
    Shelter shelter;
    table.need("from_s");
    table.need("to_s");
    table.number("from_s", shelter.from_s, 0, 36000);
    table.number("to_s", shelter.to_s, 0, 36000);
    table.number("amount", shelter.amount, 0, 1);
    if (shelter.to_s <= shelter.from_s) table.complain("to_s", "must come after \"from_s\"");
    table.finish();
    return shelter;
}

} // namespace

Result<DiveFile> loadDive(const Path& path, const SpeciesTable& known) {
    auto opened = TomlFile::open(path);
    if (!opened) return opened.error();
    TomlFile& file = *opened;
    TomlTable root(file, file.root());
    DiveFile dive;
    dive.name = path.stem().string();
    dive.title = dive.name;
    root.text("title", dive.title);
    root.text("video", dive.video);
    root.number("duration", dive.duration_s, 5, 3600);
    root.number("exposure", dive.exposure_ev, -10, 10);
    root.number("floor", dive.floor_m, -3, -0.5f);
    root.flag("water", dive.water);
    if (dive.video.find("..") != std::string::npos || dive.video.starts_with('/'))
        root.complain("video", "must name a file below content/");

    root.need("school");
    int fish = 0;
    if (const auto* schools = root.list("school"))
        for (const toml::node& node : *schools) {
            if (!node.is_table()) {
                file.complain(&node, "each school must be a table [[school]]");
                break;
            }
            dive.schools.push_back(readSchool(file, *node.as_table(), known));
            fish += dive.schools.back().count;
            if (dive.schools.back().heightLow_m < dive.floor_m + 0.1f)
                file.complain(&node, "\"height\" reaches into the floor");
            if (fish > kMaxFish) {
                file.complain(&node, "more than " + std::to_string(kMaxFish) + " fish");
                break;
            }
        }
    if (const auto* shark = root.table("shark")) dive.shark = readShark(file, *shark, known);
    if (const auto* shelters = root.list("shelter"))
        for (const toml::node& node : *shelters) {
            if (!node.is_table()) {
                file.complain(&node, "each shelter must be a table [[shelter]]");
                break;
            }
            if (dive.shelter.size() == kMaxShelters) {
                file.complain(&node, "more than 100 shelters");
                break;
            }
            dive.shelter.push_back(readShelter(file, *node.as_table()));
        }
    root.finish();
    if (auto status = file.status(); !status) return status.error();
    return dive;
}

} // namespace shoal::game
