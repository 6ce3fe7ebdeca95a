#include "game/rules/DiveFile.h"

#include "game/rules/TomlRead.h"

namespace shoal::game {

namespace {

constexpr int kMaxFish = 1000;
constexpr size_t kMaxVisits = 100;
constexpr size_t kMaxMarks = 100;

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

void readStretch(TomlTable& table, float& from_s, float& to_s) {
    table.need("from_s");
    table.need("to_s");
    table.number("from_s", from_s, 0, 36000);
    table.number("to_s", to_s, 0, 36000);
    if (to_s <= from_s) table.complain("to_s", "must come after \"from_s\"");
}

Enclosure readEnclosure(TomlFile& file, const toml::table& entry) {
    TomlTable table(file, entry);
    Enclosure enclosure;
    readStretch(table, enclosure.from_s, enclosure.to_s);
    table.number("amount", enclosure.amount, 0, 1);
    table.finish();
    return enclosure;
}

GroundMark readGround(TomlFile& file, const toml::table& entry) {
    TomlTable table(file, entry);
    GroundMark ground;
    readStretch(table, ground.from_s, ground.to_s);
    table.need("height");
    table.number("height", ground.height_m, -10, -0.3f);
    table.finish();
    return ground;
}

// Of a list of tables [[name]], each read by `read`.
template <class TimeRange>
void readMarks(TomlFile& file, TomlTable& root, const char* name,
               TimeRange (*read)(TomlFile&, const toml::table&), std::vector<TimeRange>& out) {
    const auto* marks = root.list(name);
    if (!marks) return;
    for (const toml::node& node : *marks) {
        if (!node.is_table()) {
            file.complain(&node, "each " + std::string(name) + " must be a table [[" + name + "]]");
            return;
        }
        if (out.size() == kMaxMarks) {
            file.complain(&node, "more than 100 of " + std::string(name));
            return;
        }
        out.push_back(read(file, *node.as_table()));
    }
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
    readMarks(file, root, "shelter", readEnclosure, dive.enclosure);
    readMarks(file, root, "ground", readGround, dive.ground);
    root.finish();
    if (auto status = file.status(); !status) return status.error();
    return dive;
}

} // namespace shoal::game
