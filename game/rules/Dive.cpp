#include "game/rules/Dive.h"

#include "engine/core/Hash.h"
#include "engine/core/Number.h"
#include "game/rules/Intent.h"
#include "game/rules/SharkBehaviour.h"

#include <fmt/core.h>

#include <bit>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <utility>

namespace shoal::game {

// Moves the fish's bands up and in for a seated player, who has a lap and cannot step towards fish.
static void bringToSeated(DiveFile& dive) {
    constexpr float kLap_m = -0.45f, kFloor_m = -0.9f; // relative to the eyes
    constexpr float kStep_m = 0.3f, kMinBand_m = 0.3f;
    dive.floor_m = std::max(dive.floor_m, kFloor_m);
    for (School& school : dive.schools) {
        school.heightLow_m = std::max(school.heightLow_m, kLap_m);
        school.heightHigh_m = std::max(school.heightHigh_m, school.heightLow_m + kMinBand_m);
        school.radiusHigh_m = std::max(school.radiusHigh_m - kStep_m,
                                       std::min(school.radiusHigh_m, school.radiusLow_m + kMinBand_m));
    }
}

// A giant's sound comes from its true direction but from this distance, since a whale's voice carries far.
constexpr float kHeardFrom_m = 1.5f;

// The encounter of a dive: a giant (a whale), too large to catch, swims past once. It reacts to nothing, and
// nothing collides with it. The field guide counts it as met when it sets out. id: its creature id.
static void passBy(Giant& giant, int id, Score& score, const DiveContext& in, Events& events) {
    const EncounterPlan& plan = in.dive.encounter;
    if (plan.species < 0 || in.state.time_s() < plan.at_s || giant.state == Giant::State::Gone) return;
    const Species& kind = in.species[plan.species];
    if (giant.state == Giant::State::ToCome) {
        giant.state = Giant::State::Passing;
        giant.position = plan.from;
        giant.forward = normalizedOr(plan.to - plan.from, {0, 0, 1});
        giant.speed = kind.cruise_mps;
        giant.worldFromBody = bodyTurn(giant.forward, 0);
        giant.shape.amplitude = tailAmplitude(1);
        score.species[plan.species].touched = true;
        events.push_back({.kind = EventKind::Encounter,
                          .creature = id,
                          .position = kHeardFrom_m * normalizedOr(plan.from, kUp)});
    }
    giant.velocity = giant.forward * giant.speed;
    giant.position += giant.velocity * kDt;
    beatTail(giant, kind);
    giant.gait.advance(1);
    if (glm::dot(plan.to - giant.position, giant.forward) <= 0) giant.state = Giant::State::Gone;
}

Dive::Dive(SpeciesTable species, DiveFile file, uint64_t seed, DiveRules rules)
    : files_{std::move(species), std::move(file)}, rules_(rules) {
    if (rules_.freeSwim) {
        files_.dive.shark.species = -1;
        files_.dive.goals.clear();
    }
    if (rules_.seated) bringToSeated(files_.dive);
    if (rules_.roomFloor_cm > 0) {
        files_.dive.space = nullptr;
        files_.dive.floor_m = -0.01f * static_cast<float>(rules_.roomFloor_cm);
    }
    std::erase_if(files_.dive.schools, [&](const School& school) { return school.stars > rules_.stars; });
    begin(seed);
}

void Dive::begin(uint64_t seed) {
    state_.seed = seed;
    state_.random = Random(seed, 1);
    state_.tick = 0;
    state_.phase = Phase::Diving;
    state_.begun = state_.toldOfNoGuest = false;
    state_.score = {.species = std::vector<SpeciesTally>(files_.species.size()),
                    .goals = drawGoals(files_.dive.goals, seed)};
    state_.score.reached.resize(state_.score.goals.size());
    for (Hand& hand : state_.hands) {
        hand.grasp.holds = hand.grasp.encloses = -1;
        hand.grasp.window = 0;
        hand.fed = false;
        hand.intent = {};
        hand.lastMiss = Miss::None;
        hand.stung_s = hand.rested_s = hand.nextVisit_s = hand.baitLeft_s = 0;
    }
    state_.contacts.clear();
    spawnFish(files_, state_.random, Random(seed, 2), state_.fish);
    neighbours_.resize(state_.fish.size());
    state_.shark = spawnShark(files_, state_.random);
    state_.giant = {};
    startInFreeSpace(state_.fish, context());
    startInFreeSpace(state_.shark, context());
}

void Dive::step(const TickInput& input, Events& events) {
    DiveState& s = state_;
    const size_t before = events.size();
    const bool restart = input.restart && !s.restartHeld;
    s.restartHeld = input.restart;
    if (restart) begin(s.seed + 1);
    s.paused = input.pause;
    if (s.paused && s.begun) return;

    ++s.totalTicks;
    ++s.tick;
    if (!s.begun) {
        s.begun = true;
        events.push_back({EventKind::DiveStart});
    }
    const DiveContext in = context();
    const bool diving = s.phase == Phase::Diving;
    trackHands(input, s.view, s.hands);
    readIntents(s.hands, s.fish, in);
    frightenByHands(s.fish, in, s.random, events);
    followHands(s.hands, s.fish, in);
    touch(events);
    closeHands(s.hands, s.fish, in, events);
    chooseVisitors(s.hands, s.fish, in, s.random);
    offerBait(s.hands, s.fish, s.toldOfNoGuest, events);
    swimFish(s.fish, in, neighbours_, s.random);
    if (s.shark.present) {
        decide(s.shark, s.fish, in, s.random, events);
        swimShark(s.shark, in);
        bite(s.shark, s.hands, s.fish, s.score, in, events);
    }
    thingMover_.move(world_, s.fish, s.shark, in, s.random, events);
    passBy(s.giant, giantId(), s.score, in, events);
    showCatches(s.fish, in, events);
    countCatches(s.hands, s.fish, s.score, in, events);
    for (Hand& hand : s.hands)
        if (hand.visible) easeFingers(hand);
    if (!diving) return;
    endWhenOver(events);
    countForGoals(std::span(events).subspan(before), in, s.score.goalCounts);
    reachGoals(events);
}

void Dive::touch(Events& events) {
    DiveState& s = state_;
    const DiveContext in = context();
    handContacts_.collide(world_, s.fish, in, s.contacts);
    forEachCreature(s.contacts, [&](int id, std::span<const physics::Contact> own) {
        if (id == static_cast<int>(s.fish.size()))
            return bumpHands(s.shark, own, s.hands, s.fish, in, events);
        Fish& fish = s.fish[id];
        for (const physics::Contact& contact : own) feel(contact, fish, s.hands);
        s.score.species[fish.species].touched = true;
        if (fish.heldBy < 0) pushFish(fish, id, own, in, s.random, events);
    });
    for (Fish& fish : s.fish)
        fish.flight.touchedGently_s = std::max(0.0f, fish.flight.touchedGently_s - 0.1f * kDt);
}

void Dive::endWhenOver(Events& events) {
    DiveState& s = state_;
    if (rules_.freeSwim || s.tick < static_cast<uint32_t>(files_.dive.duration_s * sim::kTickRate_Hz)) return;
    s.phase = Phase::Results;
    for (int h = 0; h < 2; ++h) {
        s.hands[h].baitLeft_s = 0;
        if (s.hands[h].grasp.holds >= 0) drop(s.hands[h], h, s.fish, context(), events);
    }
    events.push_back({EventKind::DiveOver});
}

void Dive::reachGoals(Events& events) {
    DiveState& s = state_;
    for (size_t i = 0; i < s.score.goals.size(); ++i) {
        const Goal& goal = files_.dive.goals[s.score.goals[i]];
        if (s.score.reached[i] || !isReached(goal, s.score, s.phase == Phase::Results)) continue;
        s.score.reached[i] = true;
        events.push_back({.kind = EventKind::Goal, .goal = static_cast<int>(i)});
    }
}

// Snapshots.

static void showHand(int h, const DiveContext& in, HandView& view) {
    const Hand& hand = in.state.hands[h];
    view.visible = hand.visible;
    view.grip = hand.grip;
    view.joints = hand.fingers.shown;
    view.holds = hand.grasp.holds;
    view.touching = hand.touching;
    view.ready = view.haste = view.holdProgress = 0;
    for (const Fish& f : in.state.fish)
        if (f.catchableBy == h) view.ready = std::max(view.ready, f.catchable);
    view.outOfReach = fishOutOfReach(hand, in.state.fish, in);
    if (hand.solid && view.ready == 0 && !hand.grasp.closed) view.haste = hasteOf(hand, in.state.fish, in);
    if (view.holds < 0) return;
    const Fish& held = in.state.fish[view.holds];
    const float time_s = holdTime_s(in.kindOf(held));
    if (time_s > 0) view.holdProgress = std::min(1.0f, held.hold.time_s / time_s);
}

// Returns the weight of a mark at a time: 1 within it, down to 0 over kRamp_s on both sides.
static double within(const VideoMark& mark, double videoLength_s, double time_s) {
    constexpr double kRamp_s = 2;
    const auto from_s = static_cast<double>(mark.from_s);
    if (!(videoLength_s > 0) || from_s >= videoLength_s) return 0;
    const double to_s = std::min(static_cast<double>(mark.to_s), videoLength_s);
    const auto wrapped = [&](double s) { return s - std::floor(s / videoLength_s) * videoLength_s; };
    const double now_s = wrapped(time_s);
    const bool inside = now_s >= from_s && now_s <= to_s;
    const double away_s = inside ? 0 : std::min(wrapped(from_s - now_s), wrapped(now_s - to_s));
    return std::max(0.0, 1 - away_s / kRamp_s);
}

float enclosureAt(std::span<const VideoMark> marks, double videoLength_s, double time_s) {
    double maximum = 0;
    for (const VideoMark& mark : marks)
        maximum = std::max(maximum, static_cast<double>(mark.amount) * within(mark, videoLength_s, time_s));
    return static_cast<float>(maximum);
}

void Dive::snapshot(Snapshot& out) const {
    const DiveState& s = state_;
    const DiveFile& dive = files_.dive;
    out.tick = s.totalTicks;
    out.time_s = static_cast<double>(s.tick) / sim::kTickRate_Hz;
    out.phase = s.phase;
    out.paused = s.paused;
    out.freeSwim = rules_.freeSwim;
    const float spent_s = rules_.freeSwim ? 0.0f : static_cast<float>(out.time_s);
    out.timeLeft_s = s.phase == Phase::Diving ? std::max(0.0f, dive.duration_s - spent_s) : 0.0f;
    out.enclosure = enclosureAt(dive.enclosure, dive.videoLength_s, out.time_s);
    out.score = s.score.points;
    out.caught = s.score.caught;
    out.lost = s.score.lost;
    out.combo = s.score.combo();
    out.bestCombo = s.score.bestCombo;
    out.tally = s.score.species;
    out.goals.resize(s.score.goals.size());
    for (size_t i = 0; i < out.goals.size(); ++i) {
        const int goal = s.score.goals[i];
        out.goals[i] = {goal, progressOf(dive.goals[goal], s.score), s.score.reached[i]};
    }
    out.worldFromView = s.view.worldFromView;
    out.headWorld = s.view.headWorld;
    const DiveContext in = context();
    for (int h = 0; h < 2; ++h) showHand(h, in, out.hands[h]);
    const bool isThere = s.giant.state == Giant::State::Passing;
    out.creatures.resize(static_cast<size_t>(giantId()) + (isThere ? 1 : 0));
    const auto show = [&](size_t id, const Swimmer& from, int species) -> CreatureView& {
        CreatureView& view = out.creatures[id];
        view = {.id = static_cast<uint32_t>(id),
                .species = species,
                .position = from.position,
                .worldFromBody = from.worldFromBody,
                .velocity = from.velocity,
                .length = lengthOf(from, files_.species[species]),
                .gait = from.gait,
                .shape = from.shape};
        return view;
    };
    for (size_t i = 0; i < s.fish.size(); ++i) {
        const Fish& fish = s.fish[i];
        CreatureView& view = show(i, fish, fish.species);
        view.heldBy = fish.heldBy;
        view.catchable = fish.catchable;
        view.catchableBy = fish.catchableBy;
        const bool gone = fish.state == Fish::State::Gone;
        if (gone) view.position = {0, -1000, 0};
        view.hidden = gone || in.hides(fish.position);
    }
    if (s.shark.present) show(s.fish.size(), s.shark, s.shark.species);
    if (isThere) show(static_cast<size_t>(giantId()), s.giant, dive.encounter.species);
}

void interpolate(const Snapshot& before, const Snapshot& after, float alpha, Snapshot& out) {
    constexpr float kJump_m = 0.6f; // farther than anything swims or is carried in one tick
    out = after;                    // keeps out's memory: no allocation once it has grown
    if (before.creatures.size() != after.creatures.size() || after.tick != before.tick + 1 ||
        after.time_s < before.time_s)
        return;
    // Both replace `to`, the value after, by the interpolation between `from` and `to`.
    const auto mix = [&](const auto& from, auto& to) { to = from + (to - from) * alpha; };
    const auto turn = [&](const glm::quat& from, glm::quat& to) { to = blended(from, to, alpha); };
    out.time_s = before.time_s + (after.time_s - before.time_s) * static_cast<double>(alpha);
    mix(before.timeLeft_s, out.timeLeft_s);
    turn(before.worldFromView, out.worldFromView);
    mix(before.headWorld, out.headWorld);
    for (int h = 0; h < 2; ++h) {
        const HandView& from = before.hands[h];
        HandView& to = out.hands[h];
        if (!from.visible || !to.visible) continue;
        mix(from.grip, to.grip);
        for (int j = 0; j < hands::kJointCount; ++j) {
            mix(from.joints[j].position, to.joints[j].position);
            turn(from.joints[j].orientation, to.joints[j].orientation);
        }
    }
    for (size_t i = 0; i < out.creatures.size(); ++i) {
        const CreatureView& from = before.creatures[i];
        CreatureView& to = out.creatures[i];
        if (glm::distance(from.position, to.position) > kJump_m) continue;
        mix(from.position, to.position);
        mix(from.velocity, to.velocity);
        mix(from.catchable, to.catchable);
        turn(from.worldFromBody, to.worldFromBody);
        mix(from.gait.phase_s, to.gait.phase_s);
        if (from.gait.motion == to.gait.motion) mix(from.gait.blend, to.gait.blend);
        for (auto part : {&BodyShape::beats, &BodyShape::amplitude, &BodyShape::bendLeft, &BodyShape::bendUp,
                          &BodyShape::finsDown})
            mix(from.shape.*part, to.shape.*part);
    }
}

// Recordings.

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

// Visits every field but the flags of the last byte, in the order of the file.
template <class Input, class Visit> static void visit(Input& input, Visit&& io) {
    const auto quaternion = [&](auto& q) { io(q.w), io(q.x), io(q.y), io(q.z); };
    for (auto& hand : input.hands) {
        io(hand.tracked);
        io(hand.solid);
        io(hand.confidence);
        io(hand.grip);
        io(hand.pinch);
        io(hand.time_us);
        for (auto& joint : hand.joints) {
            io(joint.position);
            quaternion(joint.orientation);
            io(joint.radius);
        }
    }
    quaternion(input.worldFromView);
    io(input.headWorld);
}

constexpr const char* kFilmSpace = "film_space"; // key in a recording's settings

// Returns the hash of a film's space as a recording holds it; empty: no distances.
static std::string nameOf(const FilmSpace* space) {
    return space ? fmt::format("{:016x}", space->hash()) : "";
}

void toBytes(const TickInput& input, std::span<uint8_t, kTickInputBytes> out) {
    uint8_t* at = out.data();
    visit(input, [&](const auto& value) {
        std::memcpy(at, &value, sizeof value);
        at += sizeof value;
    });
    *at = static_cast<uint8_t>((input.pause ? 1 : 0) | (input.restart ? 2 : 0));
}

TickInput fromBytes(std::span<const uint8_t, kTickInputBytes> bytes) {
    TickInput input;
    const uint8_t* at = bytes.data();
    visit(input, [&]<class T>(T& value) {
        if constexpr (std::is_same_v<T, bool>)
            value = *at != 0; // a file may hold any byte
        else
            std::memcpy(&value, at, sizeof value);
        at += sizeof value;
    });
    input.pause = (*at & 1) != 0;
    input.restart = (*at & 2) != 0;
    return input;
}

sim::RecordingHeader recordingHeader(const Dive& dive) {
    sim::RecordingHeader header{.seed = dive.seed(), .dive = dive.file().name, .inputBytes = kTickInputBytes};
    const DiveRules& rules = dive.rules();
    header.settings = {{"film", dive.file().video},
                       {"assist", enumName(rules.assist)},
                       {"free_swim", rules.freeSwim ? "on" : "off"},
                       {"seated", rules.seated ? "on" : "off"},
                       {"stars", std::to_string(rules.stars)},
                       {"room_floor_cm", std::to_string(rules.roomFloor_cm)}};
    if (dive.file().space) header.settings[kFilmSpace] = nameOf(dive.file().space.get());
    return header;
}

Result<DiveRules> rulesOf(const sim::RecordingHeader& header) {
    if (header.inputBytes != kTickInputBytes)
        return Error{"the recording", "holds inputs of another kind than this version of the game takes"};
    DiveRules rules;
    for (const auto& [name, value] : header.settings) {
        bool* flag = name == "free_swim" ? &rules.freeSwim : name == "seated" ? &rules.seated : nullptr;
        const auto assist = enumNamed<Assist>(value);
        int* count = name == "stars" ? &rules.stars : name == "room_floor_cm" ? &rules.roomFloor_cm : nullptr;
        const auto number = parseNumber(value, 0, count == &rules.stars ? 1'000'000'000 : kDeepest_cm);
        if (count && number)
            *count = *number;
        else if (name == "assist" && assist)
            rules.assist = *assist;
        else if (flag && (value == "on" || value == "off"))
            *flag = value == "on";
        else if (flag || name == "assist" || count) // others are settings of the program, no rules
            return Error{"the recording", "has an unknown value: " + name + " = " + value};
    }
    return rules;
}

std::string filmOf(const sim::RecordingHeader& header, const std::string& own) {
    const auto film = header.settings.find("film");
    return film == header.settings.end() || film->second.find("..") != std::string::npos ? own : film->second;
}

bool needsFilmSpace(const sim::RecordingHeader& header) { return header.settings.contains(kFilmSpace); }

Status checkFilmSpace(const sim::RecordingHeader& header, const FilmSpace* space) {
    const auto found = header.settings.find(kFilmSpace);
    const std::string recorded = found == header.settings.end() ? "" : found->second, here = nameOf(space);
    if (recorded == here) return Done{};
    if (recorded.empty()) return Error{"the recording", "was made in a film without distances"};
    return Error{"the recording", fmt::format("was made in a film with other distances: {}, here {}",
                                              recorded, here.empty() ? "none" : here)};
}

// Hash of simulation state over all fields in the order of their declarations. A struct with a base class has
// a member fields() that ties the base and its own fields; if it omits a field, it does not compile.

// fieldCount() returns the number of an aggregate's elements: the most initialisers that it accepts.
struct AnyField {
    template <class T> operator T() const;
};
template <class T, class... Fields> consteval size_t fieldCount() {
    if constexpr (requires { T{Fields{}..., AnyField{}}; })
        return fieldCount<T, Fields..., AnyField>();
    else
        return sizeof...(Fields);
}

inline auto fieldsOf(const glm::vec3& v) { return std::tie(v.x, v.y, v.z); }
inline auto fieldsOf(const glm::quat& q) { return std::tie(q.w, q.x, q.y, q.z); }
template <class T>
requires requires(const T& state) { state.fields(); }
auto fieldsOf(const T& state) { return state.fields(); }

// Ties the fields of an aggregate, for the numbers of fields that occur in the state.
template <class T> auto fieldsOf(const T& state) {
#define SHOAL_TIE(number, ...)                                                                               \
    if constexpr (fieldCount<T>() == number) {                                                               \
        const auto& [__VA_ARGS__] = state;                                                                   \
        return std::tie(__VA_ARGS__);                                                                        \
    }
    SHOAL_TIE(2, a, b);
    SHOAL_TIE(3, a, b, c);
    SHOAL_TIE(4, a, b, c, d);
    SHOAL_TIE(5, a, b, c, d, e);
    SHOAL_TIE(6, a, b, c, d, e, f);
    SHOAL_TIE(7, a, b, c, d, e, f, g);
    SHOAL_TIE(8, a, b, c, d, e, f, g, h);
    SHOAL_TIE(10, a, b, c, d, e, f, g, h, i, j);
    SHOAL_TIE(11, a, b, c, d, e, f, g, h, i, j, k);
    SHOAL_TIE(12, a, b, c, d, e, f, g, h, i, j, k, l);
    SHOAL_TIE(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
    SHOAL_TIE(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z);
#undef SHOAL_TIE
}

template <class T> void addState(Hash& hash, const T& value);
inline void addState(Hash& hash, const Random& random) { hash.add(random.state()); }
template <class T> void addState(Hash& hash, const std::vector<T>& values) {
    hash.add(values.size());
    for (const T& value : values) addState(hash, value);
}
template <class T, size_t N> void addState(Hash& hash, const std::array<T, N>& values) {
    for (const T& value : values) addState(hash, value);
}
template <class T> void addState(Hash& hash, const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
        hash.add(value);
    } else {
        const auto fields = fieldsOf(value);
        if constexpr (std::is_aggregate_v<T>)
            static_assert(std::tuple_size_v<decltype(fields)> == fieldCount<T>(), "a field is missing");
        std::apply([&](const auto&... field) { (addState(hash, field), ...); }, fields);
    }
}

uint64_t Dive::stateHash() const {
    Hash hash;
    addState(hash, state_);
    return hash.value();
}

} // namespace shoal::game
