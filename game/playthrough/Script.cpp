#include "game/playthrough/Script.h"

#include "engine/math/Trigonometry.h"
#include "game/rules/Intent.h"
#include "game/rules/TomlRead.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::game {

constexpr int kMaxSteps = 1000, kMaxExpects = 200;

constexpr std::array<const char*, 18> kDoNames = {"reach",   "move",  "close", "open",  "throw", "wave",
                                                  "hover",   "offer", "rest",  "hold",  "look",  "wait",
                                                  "restart", "pause", "again", "point", "press", "release"};
constexpr std::array<const char*, 2> kHandNames = {"left", "right"}, kPhaseNames = {"diving", "results"};
constexpr std::array<const char*, 2> kAtNames = {"shark", "fish"}, kWaterNames = {"open", "film"};

static ScriptStep readStep(TomlTable& table, int number) {
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
    table.choice("until", kEnumNames<EventKind>, step.until);
    table.choice("unless", kEnumNames<EventKind>, step.unless);
    table.choice("phase", kPhaseNames, step.phase);
    table.whole("from", step.from, 1, kMaxSteps);
    table.whole("times", step.times, 1, 1000);
    if (step.what == ScriptStep::Do::Again && step.from >= number)
        table.complain("from", "must name an earlier step");
    table.flag("optional", step.optional);
    return step;
}

static ScriptExpect readExpect(TomlTable& table) {
    ScriptExpect expect;
    expect.line = table.line();
    for (size_t i = 0; i < kEndValues.size(); ++i)
        if (const char* key = kEndValues[i].key; table.has(key))
            table.whole(key, expect.atEnd[i].emplace(), 0, 1'000'000);
    if (table.has("fish_above")) table.number("fish_above", expect.fishAbove_m.emplace(), -10, 10);
    table.choice("water", kWaterNames, expect.water);
    table.choice("event", kEnumNames<EventKind>, expect.event);
    table.choice("never", kEnumNames<EventKind>, expect.never);
    table.choice("phase", kPhaseNames, expect.phase);
    table.whole("count", expect.count, 1, 1'000'000);
    table.number("after", expect.after_s, 0, 3600);
    table.number("before", expect.before_s, 0, 3600);
    if (const auto* order = table.list("order"))
        for (const toml::node& node : *order) {
            const auto kind = enumNamed<EventKind>(node.value<std::string>().value_or(""));
            if (!kind) table.complain("order", "must list names of events");
            expect.order.push_back(*kind);
        }
    return expect;
}

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

// Motions and verdict of a script's player.

constexpr float kHandSpeed_mps = 1.5f;
constexpr float kHeadSpeed_radps = 2.2f;
constexpr float kCloseTime_s = 0.12f;
constexpr float kReach_m = 1.2f; // reach of a person's arm; the hand rig allows more
constexpr float kNear_m = 0.3f;
constexpr float kThere_m = 0.045f; // distance of grasp centre and fish's middle at which the hand closes
constexpr float kPi = std::numbers::pi_v<float>;

// The window that a script's mouse points into, with the game's field of view.
constexpr glm::vec2 kHalfWindow_px(640, 360);
constexpr float kWindowFov = 65 * kPi / 180;
constexpr float kVisibleReach_m = 1.4f;
constexpr float kMouseThere_m = 0.07f; // distance from grasp centre to fish at which Point is done

static glm::vec3 withinReach(glm::vec3 p) {
    const float distance = glm::length(p);
    if (distance < 1e-4f) return {0, 0, -kNear_m};
    return p * (std::clamp(distance, kNear_m, kReach_m) / distance);
}

static glm::vec3 restingView(int hand) { return {hand == 0 ? -0.24f : 0.24f, -0.34f, -0.38f}; }

static const CreatureView* sharkOf(const Snapshot& now, const SpeciesTable& species) {
    for (const CreatureView& creature : now.creatures)
        if (species[creature.species].shark) return &creature;
    return nullptr;
}

static bool isFree(const CreatureView& creature, const ScriptStep& step, const SpeciesTable& species) {
    const Species& kind = species[creature.species];
    const bool asked = step.kind == "any" ? isFish(kind) : kind.name == step.kind;
    return asked && creature.heldBy < 0 && creature.gait.motion != Motion::Struggle;
}

// Returns the window's pixel of a place in front of the viewer, viewer's frame.
static glm::vec2 pixelOf(glm::vec3 view) {
    const float half = 0.5f * kWindowFov, focal_px = kHalfWindow_px.y * math::cosine(half) / math::sine(half);
    return kHalfWindow_px + glm::vec2(view.x, -view.y) * (focal_px / std::max(-view.z, 0.05f));
}

// Returns the nearest fish within reach and well inside the window; -1: none.
static int chooseVisible(const ScriptStep& step, const Snapshot& now, const SpeciesTable& species) {
    return leastCost(now.creatures, kVisibleReach_m, [&](const CreatureView& creature) {
        const glm::vec3 view = glm::conjugate(now.worldFromView) * creature.position;
        const glm::vec2 fromMiddle = glm::abs(pixelOf(view) / kHalfWindow_px - 1.0f);
        if (!isFree(creature, step, species) || creature.gait.motion == Motion::Dart || view.z > -kNear_m)
            return kNever;
        return std::max(fromMiddle.x, fromMiddle.y) > 0.8f ? kNever : glm::length(view);
    });
}

ScriptRun::ScriptRun(Script script, hands::HandRig rig, SpeciesTable species, bool inFilm)
    : script_(std::move(script)), rig_(std::move(rig)), species_(std::move(species)), inFilm_(inFilm),
      mouse_(rig_), repeats_(script_.steps.size(), 0) {
    occurred_.reserve(4096);
    mouseInput_.fovY = kWindowFov;
}

void ScriptRun::moveHand(int h, glm::vec3 goalWorld, float speed) {
    ScriptHand& hand = hands_[h];
    hand.graspWorld += limited(withinReach(goalWorld) - hand.graspWorld, speed * kDt);
}

void ScriptRun::lookTowards(glm::vec3 direction) {
    const float goalYaw = math::arcTangent(direction.x, -direction.z);
    const float goalPitch = math::arcTangent(direction.y, glm::length(glm::vec2(direction.x, direction.z)));
    const float turn = std::remainder(goalYaw - yaw_, 2 * kPi);
    yaw_ += std::clamp(turn, -kHeadSpeed_radps * kDt, kHeadSpeed_radps * kDt);
    pitch_ = towards(pitch_, std::clamp(goalPitch, -1.2f, 1.2f), kHeadSpeed_radps * kDt);
}

int ScriptRun::chooseFish(const ScriptStep& step, const Snapshot& now) const {
    const ScriptHand& hand = hands_[step.hand];
    const ScriptHand& other = hands_[1 - step.hand];
    return leastCost(now.creatures, kNever, [&](const CreatureView& creature) {
        const bool taken = static_cast<int>(creature.id) == other.target && other.closedGoal > 0;
        if (taken || !isFree(creature, step, species_)) return kNever;
        const glm::vec3 soon = creature.position + 0.4f * creature.velocity;
        const float distance = glm::length(soon);
        float cost = glm::distance(soon, hand.graspWorld);
        cost += 12 * std::max(0.0f, distance - (kReach_m - 0.1f)) + 4 * std::max(0.0f, 0.45f - distance);
        cost += 0.5f *
                std::max(0.0f, -glm::dot(soon, now.worldFromView * glm::vec3(0, 0, -1))); // behind the back
        return creature.gait.motion == Motion::Dart ? cost + 1.5f : cost;
    });
}

// Moves the hand along with its fish. Returns whether it could close on it, or is at its offset from it.
bool ScriptRun::follow(int h, const Snapshot& now) {
    ScriptHand& hand = hands_[h];
    if (hand.target < 0 || hand.target >= static_cast<int>(now.creatures.size())) return false;
    const CreatureView& fish = now.creatures[hand.target];
    if (fish.heldBy == h) return true;
    const glm::vec3 place = fish.position + now.worldFromView * hand.offset,
                    goal = place + fish.velocity * (2 * kDt);
    const float distance = glm::distance(goal, hand.graspWorld);
    // The hand comes fast from afar and slowly at the end, always keeping up with the fish.
    const float speed =
        std::min(kHandSpeed_mps, std::clamp(1.8f * distance, 0.2f, 1.2f) + glm::length(fish.velocity));
    lookTowards(fish.position);
    moveHand(h, goal, speed);
    return glm::distance(place, hand.graspWorld) < kThere_m;
}

// Brings the hand to a fish; chooses another when this one fled, is out of reach, or took two seconds.
bool ScriptRun::reach(const ScriptStep& step, const Snapshot& now) {
    ScriptHand& hand = hands_[step.hand];
    const uint64_t spent = tick_ - stepBegan_;
    bool again = hand.target < 0 || spent % 240 == 0;
    if (!again && spent % 60 == 0) {
        const CreatureView& fish = now.creatures[hand.target];
        again = fish.gait.motion == Motion::Dart || glm::length(fish.position) > kReach_m;
    }
    if (again) hand.target = chooseFish(step, now);
    hand.offset = step.offset;
    hand.closedGoal = 0;
    return follow(step.hand, now) && hand.closed == 0;
}

bool ScriptRun::look(const ScriptStep& step, const Snapshot& now, float spent_s) {
    glm::vec3 direction(math::sine(step.yaw) * math::cosine(step.pitch), math::sine(step.pitch),
                        -math::cosine(step.yaw) * math::cosine(step.pitch));
    if (const CreatureView* shark = step.at == ScriptStep::At::Shark ? sharkOf(now, species_) : nullptr)
        direction = shark->position;
    lookTowards(direction);
    const glm::vec3 ahead = now.worldFromView * glm::vec3(0, 0, -1);
    return glm::dot(ahead, normalizedOr(direction, ahead)) > 0.995f && spent_s >= step.seconds;
}

bool ScriptRun::wait(const ScriptStep& step, const Snapshot& now, float spent_s) const {
    if (step.phase) return now.phase == *step.phase;
    const auto isNear = [&](const CreatureView& creature) {
        return isFish(species_[creature.species]) &&
               glm::distance(creature.position, hands_[step.hand].graspWorld) < step.near_m;
    };
    if (step.near_m > 0) return spent_s >= step.seconds && std::ranges::any_of(now.creatures, isNear);
    if (!step.until) return spent_s >= step.seconds;
    const auto inStep = std::span(occurred_).subspan(occurredAtStep_);
    return std::ranges::count(inStep, *step.until, &Occurred::kind) > 0;
}

// Moves the pointer as a person does: at most two half windows a second, slower near the goal.
void ScriptRun::movePointer(glm::vec2 goal_px) {
    const glm::vec2 way = goal_px / kHalfWindow_px * glm::vec2(1, -1) + glm::vec2(-1, 1) - mouseInput_.cursor;
    const float length = glm::length(way), farthest = std::min(2.0f, 4 * length + 0.05f) * kDt;
    mouseInput_.cursor += length > farthest ? way * (farthest / length) : way;
}

// Points at a place, or at a fish, chosen anew every three seconds. Returns whether pointer or hand is there.
bool ScriptRun::point(const ScriptStep& step, const Snapshot& now) {
    if (step.at != ScriptStep::At::Fish) {
        movePointer(step.pointer_px);
        const glm::vec2 pointer_px = (mouseInput_.cursor * glm::vec2(1, -1) + 1.0f) * kHalfWindow_px;
        return glm::distance(pointer_px, step.pointer_px) < 1;
    }
    ScriptHand& hand = hands_[1];
    if (hand.target < 0 || (tick_ - stepBegan_) % 360 == 0) hand.target = chooseVisible(step, now, species_);
    if (hand.target < 0) return false;
    const CreatureView& fish = now.creatures[hand.target];
    constexpr float kLead_s = 0.2f;
    const glm::vec3 soon = glm::conjugate(now.worldFromView) * (fish.position + fish.velocity * kLead_s);
    movePointer(pixelOf(soon));
    return glm::distance(hands::graspCentre(now.hands[1].joints), fish.position) < kMouseThere_m;
}

// Performs a step for one tick. Returns whether it is done.
bool ScriptRun::perform(const ScriptStep& step, const Snapshot& now, TickInput& out) {
    using Do = ScriptStep::Do;
    const float spent_s = static_cast<float>(tick_ - stepBegan_) * kDt;
    ScriptHand& hand = hands_[step.hand];
    switch (step.what) {
    case Do::Reach:
        return reach(step, now);
    case Do::Move:
        moveHand(step.hand, now.worldFromView * step.to, step.speed);
        hand.target = -1;
        return glm::distance(hand.graspWorld, now.worldFromView * step.to) < 0.01f;
    case Do::Throw: {
        const CreatureView* shark = step.at == ScriptStep::At::Shark ? sharkOf(now, species_) : nullptr;
        hand.target = -1;
        hand.closedGoal = 0;
        moveHand(step.hand, shark ? shark->position : now.worldFromView * step.to, step.speed);
        return hand.closed <= 0;
    }
    case Do::Close:
        hand.closedGoal = 1;
        follow(step.hand, now);
        return hand.closed >= 1 && spent_s >= kCloseTime_s;
    case Do::Hold:
        return spent_s >= step.seconds;
    case Do::Open:
        hand.closedGoal = 0;
        return hand.closed <= 0;
    case Do::Look:
        return look(step, now, spent_s);
    case Do::Wait:
        return wait(step, now, spent_s);
    case Do::Wave: { // over 1 m, as a triangle wave, so that the speed is constant
        if (tick_ == stepBegan_) hand.anchor = hand.graspWorld;
        const float way = std::fmod(spent_s * step.speed + 0.5f, 2.0f);
        const float x = way < 1 ? way - 0.5f : 1.5f - way;
        hand.graspWorld = hand.anchor + now.worldFromView * glm::vec3(x, 0, 0);
        return spent_s >= step.seconds;
    }
    case Do::Hover:
    case Do::Offer:
        if (const CreatureView* shark = sharkOf(now, species_)) {
            const float ahead_m = step.what == Do::Hover ? 0 : 0.46f * shark->length; // to its mouth
            lookTowards(shark->position);
            moveHand(step.hand, shark->position + shark->worldFromBody * glm::vec3(0, 0, ahead_m),
                     kHandSpeed_mps);
        }
        return spent_s >= step.seconds;
    case Do::Rest: {
        hand.target = -1;
        const glm::vec3 goal = now.worldFromView * restingView(step.hand);
        moveHand(step.hand, goal, kHandSpeed_mps);
        return glm::distance(hand.graspWorld, withinReach(goal)) < 0.01f;
    }
    case Do::Restart:
        out.restart = true;
        return spent_s > 0;
    case Do::Pause:
        out.pause = true;
        return spent_s >= step.seconds;
    case Do::Point:
        return point(step, now);
    case Do::Press:
    case Do::Release:
        mouseInput_.close = step.what == Do::Press;
        return true;
    case Do::Again:
        return true; // performStep() handles it
    }
    return true;
}

void ScriptRun::advance(size_t to) {
    step_ = to;
    stepBegan_ = tick_;
    occurredAtStep_ = occurred_.size();
    if (finished()) return;
    // A step that brings a hand to a fish chooses a new one.
    const ScriptStep& step = script_.steps[step_];
    if (step.what == ScriptStep::Do::Reach || step.what == ScriptStep::Do::Point)
        hands_[step.hand].target = -1;
}

// Performs the present step. The next begins on the next tick, so that every step sees its own result.
void ScriptRun::performStep(const Snapshot& now, TickInput& out) {
    const ScriptStep& step = script_.steps[step_];
    const float spent_s = static_cast<float>(tick_ - stepBegan_) * kDt;
    const bool isLate = spent_s > std::max(step.timeout_s, step.seconds + 1);
    if (step.what == ScriptStep::Do::Again) {
        const bool stops = step.unless && std::ranges::count(occurred_, *step.unless, &Occurred::kind) > 0;
        const bool repeat = repeats_[step_] < step.times && !stops;
        if (repeat) ++repeats_[step_];
        advance(repeat ? static_cast<size_t>(step.from - 1) : step_ + 1);
    } else if (perform(step, now, out) || (isLate && step.optional)) {
        advance(step_ + 1);
    } else if (isLate)
        failure_ = fmt::format("line {}: step {} was not done in time", step.line, step_ + 1);
    if (!finished() && static_cast<float>(tick_) * kDt > script_.timeout_s)
        failure_ = fmt::format("the script's time was over at step {}", step_ + 1);
}

void ScriptRun::next(const Snapshot& now, TickInput& out) {
    out = TickInput{};
    if (tick_ == 0) {
        for (int h = 0; h < 2; ++h) hands_[h].graspWorld = now.worldFromView * restingView(h);
        advance(0);
    }

    if (!finished()) performStep(now, out);

    const glm::quat worldFromView =
        glm::normalize(math::rotationAbout(kUp, -yaw_) * math::rotationAbout(glm::vec3(1, 0, 0), pitch_));
    out.worldFromView = worldFromView;
    if (script_.usesMouse) { // the same order as in the program: first the help with depth, then the hand
        mouseInput_.reach_m =
            reachHelp(now, species_, rayThroughCursor(mouseInput_), mouse_.distance_m(), reachTarget_);
        out.hands = mouse_.update(mouseInput_, kDt);
    }
    for (int h = 0; h < 2 && !script_.usesMouse; ++h) {
        ScriptHand& hand = hands_[h];
        hand.closed = towards(hand.closed, hand.closedGoal, kDt / kCloseTime_s);
        out.hands[h] = hands::reachingHand(rig_, h == 0 ? hands::Side::Left : hands::Side::Right,
                                           glm::conjugate(worldFromView) * hand.graspWorld, hand.closed);
    }
    ++tick_;
}

void ScriptRun::observe(std::span<const Event> events, uint64_t stateHash, const Snapshot& after) {
    hash_.add(stateHash);
    for (const Event& event : events) occurred_.push_back({event.kind, static_cast<float>(tick_) * kDt});
    for (const CreatureView& creature : after.creatures)
        if (isFish(species_[creature.species]) && creature.heldBy < 0)
            lowestFish_m_ = std::min(lowestFish_m_, creature.position.y);
    last_ = after;
}

Status ScriptRun::verdict() const {
    if (!failure_.empty()) return Error{script_.name, failure_};
    if (!finished()) return Error{script_.name, "the script has not ended"};
    for (const ScriptExpect& expect : script_.expects) {
        if (expect.water && (*expect.water == ScriptExpect::Water::Film) != inFilm_) continue;
        if (const std::string reason = unmet(expect); !reason.empty())
            return Error{script_.name, fmt::format("line {}: {}", expect.line, reason)};
    }
    return Done{};
}

// Returns what was not as expected; empty: all was.
std::string ScriptRun::unmet(const ScriptExpect& e) const {
    const auto name = [](EventKind kind) { return rowOf(kind).name; };
    for (size_t i = 0; i < kEndValues.size(); ++i) {
        const EndValue& end = kEndValues[i];
        const int is = last_.*end.value;
        if (e.atEnd[i] && (end.isLeast ? is < *e.atEnd[i] : is != *e.atEnd[i]))
            return fmt::format("{} {}, expected {}", end.key, is, *e.atEnd[i]);
    }
    if (e.fishAbove_m && lowestFish_m_ < *e.fishAbove_m)
        return fmt::format("a fish was at {} m, expected above {}", lowestFish_m_, *e.fishAbove_m);
    if (e.phase && last_.phase != *e.phase) return "ended in the other phase";
    int count = 0;
    size_t inOrder = 0;
    for (const Occurred& event : occurred_) {
        if (e.never == event.kind)
            return fmt::format("\"{}\" at {} s, expected never", name(event.kind), event.time_s);
        count += e.event == event.kind && event.time_s >= e.after_s && event.time_s <= e.before_s;
        if (inOrder < e.order.size() && event.kind == e.order[inOrder]) ++inOrder;
    }
    if (e.event && count < e.count)
        return fmt::format("\"{}\" occurred {} times in the given time, expected {}", name(*e.event), count,
                           e.count);
    if (inOrder < e.order.size())
        return fmt::format("\"{}\" did not occur in its place of the order", name(e.order[inOrder]));
    return {};
}

} // namespace shoal::game
