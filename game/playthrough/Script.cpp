#include "game/playthrough/Script.h"

#include "game/rules/TomlRead.h"

#include <algorithm>
#include <numbers>

namespace shoal::game {

namespace {

constexpr int kMaxSteps = 1000, kMaxExpects = 200;

constexpr std::array<const char*, 17> kDoNames = {"reach", "move",  "close", "open",  "wave",   "hover",
                                                  "offer", "rest",  "hold",  "look",  "wait",   "restart",
                                                  "pause", "again", "point", "press", "release"};
constexpr std::array<const char*, 2> kHandNames = {"left", "right"}, kPhaseNames = {"diving", "results"};
constexpr std::array<const char*, 2> kAtNames = {"shark", "fish"}, kWaterNames = {"open", "film"};

constexpr auto kEventNames = [] {
    std::array<const char*, kEventRows.size()> names{};
    for (size_t i = 0; i < names.size(); ++i) names[i] = kEventRows[i].name;
    return names;
}();

ScriptStep readStep(TomlTable& table, int number) {
    ScriptStep step;
    step.line = table.line();
    table.need("do");
    table.choice("do", kDoNames, step.what);
    table.choice("hand", kHandNames, step.hand);
    table.text("kind", step.kind);
    table.choice("at", kAtNames, step.at);
    table.triple("offset", step.offset, -2, 2);
    table.triple("to", step.to, -2, 2);
    table.number("x", step.pointer_px.x, 0, 1280);
    table.number("y", step.pointer_px.y, 0, 720);
    table.number("near", step.near_m, 0, 10);
    constexpr float kDegree = std::numbers::pi_v<float> / 180;
    float yaw_deg = 0, pitch_deg = 0;
    table.number("seconds", step.seconds, 0, 600);
    table.number("speed", step.speed, 0.01f, 60);
    table.number("yaw_deg", yaw_deg, -360, 360);
    table.number("pitch_deg", pitch_deg, -80, 80);
    step.yaw = yaw_deg * kDegree;
    step.pitch = pitch_deg * kDegree;
    table.number("timeout", step.timeout_s, 0, 3600);
    table.choice("until", kEventNames, step.until);
    table.choice("unless", kEventNames, step.unless);
    table.choice("phase", kPhaseNames, step.phase);
    table.whole("from", step.from, 1, kMaxSteps);
    table.whole("times", step.times, 1, 1000);
    if (step.what == ScriptStep::Do::Again && step.from >= number)
        table.complain("from", "must name an earlier step");
    table.flag("optional", step.optional);
    return step;
}

ScriptExpect readExpect(TomlTable& table) {
    ScriptExpect expect;
    expect.line = table.line();
    for (size_t i = 0; i < kEndValues.size(); ++i)
        if (const char* key = kEndValues[i].key; table.has(key))
            table.whole(key, expect.atEnd[i].emplace(), 0, 1'000'000);
    if (table.has("fish_above")) table.number("fish_above", expect.fishAbove_m.emplace(), -10, 10);
    table.choice("water", kWaterNames, expect.water);
    table.choice("event", kEventNames, expect.event);
    table.choice("never", kEventNames, expect.never);
    table.choice("phase", kPhaseNames, expect.phase);
    table.whole("count", expect.count, 1, 1'000'000);
    table.number("after", expect.after_s, 0, 3600);
    table.number("before", expect.before_s, 0, 3600);
    if (const auto* order = table.list("order"))
        for (const toml::node& node : *order) {
            const auto kind = findEvent(node.value<std::string>().value_or(""));
            if (!kind) table.complain("order", "must list names of events");
            expect.order.push_back(*kind);
        }
    return expect;
}

} // namespace

Result<Script> loadScript(const Path& path) {
    Script script;
    script.file = script.name = path.stem().string();
    const Status read = readToml(path, [&](TomlTable& root) {
        root.text("name", script.name);
        root.text("dive", script.dive);
        if (script.dive.starts_with("./") && script.dive.ends_with(".toml"))
            script.dive = (path.parent_path() / script.dive.substr(2)).string();
        else if (script.dive.empty() || script.dive.find_first_of("/\\.") != std::string::npos)
            root.complain("dive",
                          "must be the name of a dive, or \"./\" and the path of a dive file from here");
        root.text("film", script.film);
        root.choice("assist", kEnumNames<Assist>, script.rules.assist);
        root.flag("seated", script.rules.seated);
        root.flag("free", script.rules.freeSwim);
        root.whole("seed", script.seed, 0, INT64_MAX);
        root.number("timeout", script.timeout_s, 1, 3600);
        root.need("step");
        root.tables("step", kMaxSteps, [&](TomlTable& table) {
            script.steps.push_back(readStep(table, static_cast<int>(script.steps.size()) + 1));
        });
        root.tables("expect", kMaxExpects,
                    [&](TomlTable& table) { script.expects.push_back(readExpect(table)); });
    });
    if (!read) return read.error();
    script.usesMouse = std::ranges::any_of(script.steps, &ScriptStep::movesMouse);
    if (script.usesMouse && std::ranges::any_of(script.steps, &ScriptStep::movesHand))
        return Error{path.string(), "moves both the mouse and hands: a script has either"};
    return script;
}

Result<DiveFiles> loadDiveFiles(const Script& script) {
    auto files = loadDiveFiles(script.dive);
    if (!files || script.film.empty()) return files;
    const auto other = loadDiveFiles(script.film);
    if (!other) return other.error();
    files->dive.video = other->dive.video;
    return files;
}

} // namespace shoal::game
