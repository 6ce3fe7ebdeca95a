#include "game/playthrough/Script.h"

#include "game/rules/TomlRead.h"

#include <algorithm>
#include <numbers>

namespace shoal::game {

namespace {

constexpr size_t kMaxSteps = 1000, kMaxExpects = 200;

constexpr std::array<const char*, 13> kDoNames = {"reach",   "close", "hold",  "open",  "look",
                                                  "wait",    "wave",  "hover", "offer", "rest",
                                                  "restart", "pause", "again"};

template <class Names> int indexOf(const Names& names, std::string_view name) {
    const auto found = std::find(std::begin(names), std::end(names), name);
    return found == std::end(names) ? -1 : static_cast<int>(found - std::begin(names));
}

template <class Names> std::string listed(const Names& names) {
    std::string all;
    for (const char* name : names) all += (all.empty() ? "" : ", ") + std::string(name);
    return all;
}

std::string eventNames() {
    std::vector<const char*> names;
    for (const EventRow& row : kEventRows) names.push_back(row.name);
    return listed(names);
}

void readEvent(TomlTable& table, std::string_view key, std::optional<EventKind>& value) {
    if (!table.has(key)) return;
    std::string name;
    table.text(key, name);
    value = findEvent(name);
    if (!value) table.complain(key, "must be one of " + eventNames());
}

void readPhase(TomlTable& table, std::optional<Phase>& value) {
    if (!table.has("phase")) return;
    std::string name;
    table.text("phase", name);
    if (name == "diving")
        value = Phase::Diving;
    else if (name == "results")
        value = Phase::Results;
    else
        table.complain("phase", "must be \"diving\" or \"results\"");
}

void readCount(TomlTable& table, std::string_view key, std::optional<int>& value) {
    if (!table.has(key)) return;
    int64_t count = 0;
    table.whole(key, count, 0, 1'000'000);
    value = static_cast<int>(count);
}

ScriptStep readStep(TomlFile& file, const toml::table& entry, int number) {
    TomlTable table(file, entry);
    ScriptStep step;
    step.line = table.line();
    std::string what, hand = "right";
    table.need("do");
    table.text("do", what);
    const int index = indexOf(kDoNames, what);
    if (index < 0)
        table.complain("do", "must be one of " + listed(kDoNames));
    else
        step.what = static_cast<ScriptStep::Do>(index);
    table.text("hand", hand);
    if (hand != "left" && hand != "right") table.complain("hand", "must be \"left\" or \"right\"");
    step.hand = hand == "left" ? 0 : 1;
    table.text("kind", step.kind);
    table.text("at", step.at);
    if (!step.at.empty() && step.at != "shark" && step.at != "fish")
        table.complain("at", "must be \"shark\" or \"fish\"");
    constexpr float kDegree = std::numbers::pi_v<float> / 180;
    float yaw_deg = 0, pitch_deg = 0;
    table.number("seconds", step.seconds, 0, 600);
    table.number("speed", step.speed, 0.01f, 60);
    table.number("yaw_deg", yaw_deg, -360, 360);
    table.number("pitch_deg", pitch_deg, -80, 80);
    step.yaw = yaw_deg * kDegree;
    step.pitch = pitch_deg * kDegree;
    table.number("timeout", step.timeout_s, 0, 3600);
    readEvent(table, "until", step.until);
    readEvent(table, "unless", step.unless);
    readPhase(table, step.phase);
    int64_t from = 1, times = 1;
    table.whole("from", from, 1, static_cast<int64_t>(kMaxSteps));
    table.whole("times", times, 1, 1000);
    step.from = static_cast<int>(from);
    step.times = static_cast<int>(times);
    if (step.what == ScriptStep::Do::Again && step.from >= number)
        table.complain("from", "must name an earlier step");
    table.flag("optional", step.optional);
    table.finish();
    return step;
}

ScriptExpect readExpect(TomlFile& file, const toml::table& entry) {
    TomlTable table(file, entry);
    ScriptExpect expect;
    expect.line = table.line();
    readCount(table, "caught", expect.caught);
    readCount(table, "caught_at_least", expect.caughtAtLeast);
    readCount(table, "score_at_least", expect.scoreAtLeast);
    readCount(table, "lost", expect.lost);
    readEvent(table, "event", expect.event);
    readEvent(table, "never", expect.never);
    readPhase(table, expect.phase);
    int64_t count = 1;
    table.whole("count", count, 1, 1'000'000);
    expect.count = static_cast<int>(count);
    table.number("after", expect.after_s, 0, 3600);
    table.number("before", expect.before_s, 0, 3600);
    if (const auto* order = table.list("order"))
        for (const toml::node& node : *order) {
            const auto kind = findEvent(node.value<std::string>().value_or(""));
            if (!kind) {
                table.complain("order", "must list names of events: " + eventNames());
                break;
            }
            expect.order.push_back(*kind);
        }
    table.finish();
    return expect;
}

} // namespace

Result<Script> loadScript(const Path& path) {
    auto opened = TomlFile::open(path);
    if (!opened) return opened.error();
    TomlFile& file = *opened;
    TomlTable root(file, file.root());
    Script script;
    script.name = path.stem().string();
    root.text("name", script.name);
    root.text("dive", script.dive);
    if (script.dive.starts_with("./") && script.dive.ends_with(".toml"))
        script.dive = (path.parent_path() / script.dive.substr(2)).string();
    else if (script.dive.empty() || script.dive.find_first_of("/\\.") != std::string::npos)
        root.complain("dive", "must be the name of a dive, or \"./\" and the path of a dive file from here");
    int64_t seed = 1;
    root.whole("seed", seed, 0, INT64_MAX);
    script.seed = static_cast<uint64_t>(seed);
    root.number("timeout", script.timeout_s, 1, 3600);
    root.need("step");
    if (const auto* steps = root.list("step"))
        for (const toml::node& node : *steps) {
            if (!node.is_table() || script.steps.size() == kMaxSteps) {
                file.complain(&node, node.is_table() ? "more than 1000 steps"
                                                     : "each step must be a table [[step]]");
                break;
            }
            script.steps.push_back(
                readStep(file, *node.as_table(), static_cast<int>(script.steps.size()) + 1));
        }
    if (const auto* expects = root.list("expect"))
        for (const toml::node& node : *expects) {
            if (!node.is_table() || script.expects.size() == kMaxExpects) {
                file.complain(&node, node.is_table() ? "more than 200 expectations"
                                                     : "each expectation must be a table [[expect]]");
                break;
            }
            script.expects.push_back(readExpect(file, *node.as_table()));
        }
    root.finish();
    if (auto status = file.status(); !status) return status.error();
    return script;
}

} // namespace shoal::game
