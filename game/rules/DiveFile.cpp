#include "game/rules/DiveFile.h"

#include "game/rules/TomlRead.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <filesystem>

namespace shoal::game {

constexpr int kMaxFish = 1000;
constexpr size_t kMaxVisits = 100;
constexpr size_t kMaxMarks = 100;
constexpr size_t kMaxGoals = 60;

static Species readOne(TomlTable& table) {
    Species s;
    table.need("name", "model", "length");
    table.text("name", s.name);
    table.texts("one", s.one);
    table.texts("several", s.several);
    table.texts("fact", s.fact);
    table.text("model", s.model);
    table.triple("colour", s.colour, 0, 1);
    table.flag("shark", s.shark);
    table.flag("giant", s.giant);
    table.number("length", s.length_m, 0.03f, s.giant ? 30.0f : 5.0f);
    table.number("varies", s.varies, 0, 0.5f);
    table.number("body_radius", s.bodyRadius_m, 0.01f, 0.6f);
    table.number("body_half", s.bodyHalf_m, 0, 2);
    table.number("cruise", s.cruise_mps, 0.05f, 2);
    table.number("dart", s.dart_mps, 0.1f, kMaxSpeed_mps);
    table.number("turn", s.turn_radps, 0.2f, 10);
    table.number("shyness", s.shyness, 0, 3);
    table.number("spacing", s.spacing, 0.6f, 5);
    table.number("stride", s.stride, 0.2f, 1.5f);
    table.flag("coasts", s.coasts);
    table.number("hold", s.hold_s, 0.2f, 5);
    table.flag("stings", s.stings);
    table.number("curiosity", s.curiosity, 0, 1);
    table.choice("company", kCompanyNames, s.company);
    table.choice("thing", kThingNames, s.thing);
    table.number("density", s.density_kgpm3, 100, 8000);
    table.number("drag", s.drag, 0.05f, 3);
    if (s.shark || s.giant) s.points = 0;
    table.whole("points", s.points, 0, 1000);
    if (s.name.empty()) table.complain("name", "must not be empty");
    if (s.model.find("..") != std::string::npos || s.model.starts_with('/'))
        table.complain("model", "must name a file below content/");
    if (s.dart_mps < s.cruise_mps) table.complain("dart", "must not be slower than \"cruise\"");
    if (2 * (s.bodyHalf_m + s.bodyRadius_m) > 1.1f * s.length_m)
        table.complain("body_half", "makes the body longer than \"length\"");
    return s;
}

// Returns the index of the table's species, which must be known and of that kind.
static int speciesNamed(TomlTable& table, const SpeciesTable& known, bool shark = false, bool giant = false) {
    std::string name;
    table.need("species");
    table.text("species", name);
    const int index = findSpecies(known, name);
    if (index < 0) table.complain("species", "is not known: \"" + name + "\"");
    if (known[index].shark != shark)
        table.complain("species", shark ? "must be a shark" : "must not be a shark");
    if (known[index].giant != giant)
        table.complain("species", giant ? "must be a giant" : "must not be a giant");
    return index;
}

static School readSchool(TomlTable& table, const SpeciesTable& known, bool things) {
    School school;
    school.species = speciesNamed(table, known);
    if ((known[school.species].thing != Thing::None) != things)
        table.complain("species", things ? "must be a loose thing" : "must not be a loose thing");
    table.need("count");
    table.whole("count", school.count, 1, kMaxFish);
    table.range("radius", school.radiusLow_m, school.radiusHigh_m, 0.6f, 6);
    table.range("height", school.heightLow_m, school.heightHigh_m, -2, 2);
    table.whole("stars", school.stars, 0, 1000);
    return school;
}

static SharkPlan readShark(TomlTable& table, const SpeciesTable& known) {
    SharkPlan shark;
    shark.species = speciesNamed(table, known, true);
    table.number("radius", shark.radius_m, 3, 8);
    table.number("height", shark.height_m, -1, 1);
    table.number("visit_length", shark.visitLength_s, 1, 60);
    table.number("prowl_radius", shark.prowlRadius_m, 1.1f, 3);
    if (const auto* visits = table.list("visits")) {
        if (visits->size() > kMaxVisits) table.complain("visits", "holds more than 100 times");
        for (const toml::node& node : *visits) {
            const auto at = numberIn(node, 0, 3600);
            if (!at || (!shark.visits_s.empty() && *at <= shark.visits_s.back()))
                table.complain("visits", "must be rising times in seconds");
            shark.visits_s.push_back(*at);
        }
    }
    return shark;
}

static EncounterPlan readEncounter(TomlTable& table, const SpeciesTable& known) {
    constexpr float kFar_m = 60, kRoom_m = 2.5f;
    EncounterPlan plan;
    plan.species = speciesNamed(table, known, false, true);
    table.need("at", "from", "to");
    table.number("at", plan.at_s, 0, 3600);
    table.triple("from", plan.from, -kFar_m, kFar_m);
    table.triple("to", plan.to, -kFar_m, kFar_m);
    const glm::vec3 way = plan.to - plan.from;
    const float squared = glm::dot(way, way);
    const float share = squared > 0 ? std::clamp(-glm::dot(plan.from, way) / squared, 0.0f, 1.0f) : 0.0f;
    if (glm::length(plan.from + share * way) < kRoom_m)
        table.complain("to", "must lead past the viewer at no less than 2.5 m");
    return plan;
}

static VideoMark readMark(TomlTable& table) {
    VideoMark mark;
    table.need("from_s", "to_s");
    table.number("from_s", mark.from_s, 0, 36000);
    table.number("to_s", mark.to_s, 0, 36000);
    if (mark.to_s <= mark.from_s) table.complain("to_s", "must come after \"from_s\"");
    table.number("amount", mark.amount, 0, 1);
    return mark;
}

static Goal readGoal(TomlTable& table, const SpeciesTable& known) {
    Goal goal;
    table.need("kind");
    table.choice("kind", kGoalNames, goal.kind);
    const bool first = goal.kind == GoalKind::First;
    if (first) table.need("species");
    if (table.has("species")) {
        goal.species = speciesNamed(table, known);
        const Thing thing = known[goal.species].thing;
        if (thing == Thing::Mussel || thing == Thing::Stone) table.complain("species", "cannot be caught");
        if (goal.kind != GoalKind::Catch && !first)
            table.complain("species", "belongs to goals of kind \"catch\" and \"first\"");
    }
    table.whole("level", goal.level, 1, kLevels);
    if (first) return goal;
    const bool combo = goal.kind == GoalKind::Combo, quick = goal.kind == GoalKind::Quick;
    if (goal.kind == GoalKind::NoLoss)
        goal.count = 5;
    else
        table.need("count");
    table.whole("count", goal.count, combo ? 2 : 1, combo ? kMaxCombo : quick ? kMaxQuick : 100'000);
    if (quick) table.number("within", goal.within_s, 1, 3600);
    return goal;
}

int findSpecies(const SpeciesTable& table, std::string_view name) {
    const auto found = std::ranges::find(table, name, &Species::name);
    return found == table.end() ? -1 : static_cast<int>(found - table.begin());
}

std::vector<bool> speciesShown(const SpeciesTable& table, const DiveFile& dive) {
    std::vector<bool> shown(table.size(), false);
    for (const School& school : dive.schools) shown[school.species] = true;
    for (const int species : {dive.shark.species, dive.encounter.species})
        if (species >= 0) shown[species] = true;
    return shown;
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

Result<DiveFile> loadDive(const Path& path, const SpeciesTable& known) {
    DiveFile dive;
    dive.name = dive.title = path.stem().string();
    const Status read = readToml(path, [&](TomlTable& root) {
        root.text("title", dive.title);
        root.text("video", dive.video);
        root.text("music", dive.music);
        if (dive.music.find('/') != std::string::npos) root.complain("music", "must be the name of a theme");
        root.number("duration", dive.duration_s, 5, 3600);
        root.number("lamp", dive.lamp, 0, 1);
        root.number("floor", dive.floor_m, -0.01f * kDeepest_cm, -0.5f);
        root.flag("water", dive.water);
        if (dive.video.find("..") != std::string::npos || dive.video.starts_with('/'))
            root.complain("video", "must name a file below content/");
        root.need("school");
        int fish = 0;
        for (const bool things : {false, true})
            root.tables(things ? "thing" : "school", kMaxFish, [&](TomlTable& table) {
                const School& school = dive.schools.emplace_back(readSchool(table, known, things));
                if (school.heightLow_m < dive.floor_m + 0.1f)
                    table.complain("height", "reaches into the floor");
                fish += school.count;
            });
        if (fish > kMaxFish) root.complain("school", "has more than " + std::to_string(kMaxFish) + " fish");
        root.table("shark", [&](TomlTable& table) { dive.shark = readShark(table, known); });
        root.table("encounter", [&](TomlTable& table) { dive.encounter = readEncounter(table, known); });
        root.tables("goal", kMaxGoals,
                    [&](TomlTable& table) { dive.goals.push_back(readGoal(table, known)); });
        for (int level = 1; level <= kLevels && dive.goals.size() > kGoals; ++level)
            if (std::ranges::count(dive.goals, level, &Goal::level) == 0 ||
                std::ranges::count(dive.goals, 0, &Goal::level) > 0)
                root.complain("goal", "more than three need one of each \"level\", 1 to 3");
        root.tables("enclosure", kMaxMarks,
                    [&](TomlTable& table) { dive.enclosure.push_back(readMark(table)); });
    });
    if (!read) return read.error();
    return dive;
}

std::vector<std::string> diveNames(const Path& content) {
    std::vector<std::string> names;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(content / "dives", code))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

Result<DiveFiles> loadDiveFiles(const std::string& name, const Path& content) {
    const bool isFile = name.ends_with(".toml");
    if (const auto known = diveNames(content); !isFile && std::ranges::find(known, name) == known.end())
        return Error{name, fmt::format("there is no such dive; there is {}{}", known.empty() ? "none" : "",
                                       fmt::join(known, ", "))};
    const Path file =
        isFile ? std::filesystem::absolute(name).lexically_normal() : content / "dives" / (name + ".toml");
    auto species = loadSpecies((isFile ? file.parent_path() : content) / "species.toml");
    if (!species) return species.error();
    auto dive = loadDive(file, *species);
    if (!dive) return dive.error();
    dive->name = isFile ? file.string() : name; // absolute, so that a recording finds it from any folder
    return DiveFiles{*std::move(species), *std::move(dive)};
}

} // namespace shoal::game
