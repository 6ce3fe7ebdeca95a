#include "game/playthrough/Script.h"

#include "game/rules/TomlRead.h"

#include <algorithm>
#include <numbers>

namespace shoal::game {

namespace {

constexpr int kMaxSteps = 1000, kMaxExpects = 200;

constexpr std::array<const char*, 17> kDoNames = {"reach", "move",  "close", "hold",    "open", "look",
                                                  "wait",  "wave",  "hover", "offer",   "rest", "restart",
                                                  "pause", "point", "press", "release", "again"};

constexpr std::array<const char*, 2> kHandNames = {"left", "right"}, kPhaseNames = {"diving", "results"};
constexpr std::array<const char*, 2> kAtNames = {"shark", "fish"};
constexpr std::array<const char*, 2> kWaterNames = {"open", "film"};

constexpr auto kEventNames = [] {
    std::array<const char*, kEventRows.size()> names{};
    for (size_t i = 0; i < names.size(); ++i) names[i] = kEventRows[i].name;
    return names;
}();

template <class E>
void readChoice(TomlTable& table, std::string_view key, std::span<const char* const> names,
                std::optional<E>& value) {
    if (const auto index = table.choice(key, names)) value = static_cast<E>(*index);
}

void readCount(TomlTable& table, std::string_view key, std::optional<int>& value) {
    if (!table.has(key)) return;
    table.whole(key, value.emplace(), 0, 1'000'000);
}

ScriptStep readStep(TomlTable& table, int number) {
    ScriptStep step;
    step.line = table.line();
    table.need("do");
    if (const auto what = table.choice("do", kDoNames)) step.what = static_cast<ScriptStep::Do>(*what);
    if (const auto hand = table.choice("hand", kHandNames)) step.hand = static_cast<int>(*hand);
    table.text("kind", step.kind);
    const auto at = table.choice("at", kAtNames);
    step.atShark = at == 0, step.atFish = at == 1;
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
    readChoice(table, "until", kEventNames, step.until);
    readChoice(table, "unless", kEventNames, step.unless);
    readChoice(table, "phase", kPhaseNames, step.phase);
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
    readCount(table, "caught", expect.caught);
    readCount(table, "score_at_least", expect.scoreAtLeast);
    readCount(table, "lost", expect.lost);
    readCount(table, "combo_at_least", expect.comboAtLeast);
    if (table.has("fish_above")) table.number("fish_above", expect.fishAbove_m.emplace(), -10, 10);
    if (const auto water = table.choice("water", kWaterNames))
        expect.water = *water == 0 ? ScriptExpect::Water::Open : ScriptExpect::Water::Film;
    readChoice(table, "event", kEventNames, expect.event);
    readChoice(table, "never", kEventNames, expect.never);
    readChoice(table, "phase", kPhaseNames, expect.phase);
    table.whole("count", expect.count, 1, 1'000'000);
    table.number("after", expect.after_s, 0, 3600);
    table.number("before", expect.before_s, 0, 3600);
    if (const auto* order = table.list("order"))
        for (const toml::node& node : *order) {
            const auto kind = findEvent(node.value<std::string>().value_or(""));
            if (!kind) {
                table.complain("order", "must list names of events");
                break;
            }
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
        const auto assist = root.choice("assist", EnumNames<Assist>::kNames);
        if (assist) script.rules.assist = static_cast<Assist>(*assist);
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
    const auto points = [](const ScriptStep& step) {
        return step.what >= ScriptStep::Do::Point && step.what <= ScriptStep::Do::Release;
    };
    using Do = ScriptStep::Do;
    constexpr std::array kOfHands = {Do::Reach, Do::Move,  Do::Close, Do::Open,
                                     Do::Wave,  Do::Hover, Do::Offer, Do::Rest};
    const bool holds = std::ranges::any_of(script.steps, [&](const ScriptStep& step) {
        return std::ranges::find(kOfHands, step.what) != kOfHands.end();
    });
    script.points = std::ranges::any_of(script.steps, points);
    if (script.points && holds)
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
