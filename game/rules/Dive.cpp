#include "game/rules/Dive.h"

#include "game/rules/Curiosity.h"
#include "game/rules/Encounter.h"
#include "game/rules/FishBehaviour.h"
#include "game/rules/HandTracking.h"
#include "game/rules/Holding.h"
#include "game/rules/Intent.h"
#include "game/rules/SharkBehaviour.h"
#include "game/rules/StateHash.h"

#include <fmt/core.h>

namespace shoal::game {

namespace {

// Moves the fish's bands up and in for a seated player, who has a lap and cannot step towards fish.
void bringToSeated(DiveFile& dive) {
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

} // namespace

Dive::Dive(SpeciesTable species, DiveFile file, uint64_t seed, DiveRules rules)
    : files_{std::move(species), std::move(file)}, rules_(rules) {
    if (rules_.freeSwim) {
        files_.dive.shark.species = -1;
        files_.dive.goals.clear();
    }
    if (rules_.seated) bringToSeated(files_.dive);
    begin(seed);
}

void Dive::begin(uint64_t seed) {
    state_.seed = seed;
    state_.random = Random(seed, 1);
    state_.tick = 0;
    state_.phase = Phase::Diving;
    state_.begun = false;
    state_.score = newScore(files_.species, files_.dive);
    for (Hand& hand : state_.hands) {
        hand.grasp.holds = -1;
        hand.grasp.window = 0;
        hand.intent = {};
        hand.lastMiss = Miss::None;
        hand.stung_s = hand.rested_s = hand.nextVisit_s = 0;
    }
    state_.contacts.clear();
    spawnFish(files_, state_.random, state_.fish);
    neighbours_.resize(state_.fish.size());
    state_.shark = spawnShark(files_, state_.random);
    state_.passer = {};
    const FilmMoment now = film();
    startInRoom(state_.fish, files_.species, now);
    startInRoom(state_.shark, sharkView());
}

FilmMoment Dive::film(FilmSpace::Room of, float ahead_s) const {
    return {files_.dive.space.get(),
            static_cast<double>(state_.tick) / sim::kTickRate_Hz + static_cast<double>(ahead_s), of};
}

void Dive::step(const TickInput& input, Events& events) {
    DiveState& s = state_;
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
    const FilmMoment now = film();
    const bool diving = s.phase == Phase::Diving;
    trackHands(input, s.view, s.hands);
    readIntents(s.hands, s.view, files_.species, s.fish, rules_.assist, now);
    frightenByHands(s.hands, files_.species, s.fish, s.random, events);
    followHands(s.hands, s.fish);
    touch(events);
    closeHands(s.hands, s.fish, {files_.species, s.contacts, s.view, now, rules_.assist, s.tick, diving},
               events);
    chooseVisitors(s.hands, s.view, files_.species, s.fish, s.random);
    swimFish(s.fish, {files_.dive, files_.species, s.hands, s.shark, now}, neighbours_, s.random);
    advanceShark(events);
    passBy(s.passer, files_.dive.encounter, files_.species, static_cast<float>(s.tick) * kDt, passerId(),
           s.score, events);
    countCatches(s.hands, files_.species, s.fish, s.contacts, s.score, events);
    for (Hand& hand : s.hands)
        if (hand.visible) easeFingers(hand);
    if (diving) endWhenOver(events);
    if (diving) reachGoals(events);
}

void Dive::touch(Events& events) {
    DiveState& s = state_;
    handContacts_.collide(s.hands, files_.species, s.fish, s.shark, s.contacts);
    forEachCreature(s.contacts, [&](int id, std::span<const physics::Contact> own) {
        if (id == static_cast<int>(s.fish.size()))
            return bumpHands(s.shark, files_.species, own, s.hands, s.fish, events);
        Fish& fish = s.fish[id];
        for (const physics::Contact& contact : own) feel(contact, fish, s.hands);
        s.score.species[static_cast<size_t>(fish.species)].touched = true;
        if (fish.heldBy < 0)
            pushFish(fish, id, files_.species[fish.species], own, s.hands, s.tick, s.random, events);
    });
    for (Fish& fish : s.fish) fish.nervous_s = std::max(0.0f, fish.nervous_s - 0.1f * kDt);
}

SharkView Dive::sharkView() const {
    return {files_.dive,
            files_.species,
            state_.hands,
            state_.fish,
            static_cast<float>(state_.tick) * kDt,
            state_.phase != Phase::Diving,
            film(FilmSpace::Room::Shark),
            film(FilmSpace::Room::Shark, kSoon_s),
            film(FilmSpace::Room::Shark, kLater_s)};
}

void Dive::advanceShark(Events& events) {
    DiveState& s = state_;
    if (!s.shark.present) return;
    const SharkView view = sharkView();
    decide(s.shark, view, events);
    swimShark(s.shark, view);
    bite(s.shark, view, s.hands, s.fish, s.score, events);
}

void Dive::endWhenOver(Events& events) {
    DiveState& s = state_;
    if (rules_.freeSwim || s.tick < static_cast<uint32_t>(files_.dive.duration_s * sim::kTickRate_Hz)) return;
    for (int h = 0; h < 2; ++h)
        if (s.hands[h].grasp.holds >= 0) drop(s.hands[h], h, files_.species, s.fish, events);
    s.phase = Phase::Results;
    events.push_back({EventKind::DiveOver});
}

void Dive::reachGoals(Events& events) {
    DiveState& s = state_;
    for (size_t i = 0; i < files_.dive.goals.size(); ++i) {
        if (s.score.reached[i] || !isReached(files_.dive.goals[i], s.score, s.phase == Phase::Results))
            continue;
        s.score.reached[i] = true;
        events.push_back({.kind = EventKind::Goal, .goal = static_cast<int>(i)});
    }
}

namespace {

constexpr const char* kFilmSpace = "film_space"; // key in a recording's settings

std::string nameOf(const FilmSpace& space) { return fmt::format("{:016x}", space.hash()); }

} // namespace

sim::RecordingHeader recordingHeader(const Dive& dive) {
    sim::RecordingHeader header;
    header.seed = dive.seed();
    header.dive = dive.file().name;
    header.inputBytes = kTickInputBytes;
    const DiveRules& rules = dive.rules();
    header.settings = {{"film", dive.file().video},
                       {"assist", enumName(rules.assist)},
                       {"free_swim", rules.freeSwim ? "on" : "off"},
                       {"seated", rules.seated ? "on" : "off"}};
    if (const FilmSpace* space = dive.file().space.get()) header.settings[kFilmSpace] = nameOf(*space);
    return header;
}

Result<DiveRules> rulesOf(const sim::RecordingHeader& header) {
    if (header.inputBytes != kTickInputBytes)
        return Error{"the recording", "holds inputs of another kind than this version of the game takes"};
    DiveRules rules;
    for (const auto& [name, value] : header.settings) {
        const bool on = value == "on";
        bool known = on || value == "off";
        if (name == "assist") {
            const auto assist = enumNamed<Assist>(value);
            known = assist.has_value();
            rules.assist = assist.value_or(Assist::None);
        } else if (name == "free_swim")
            rules.freeSwim = on;
        else if (name == "seated")
            rules.seated = on;
        else
            continue; // a setting of the program, no rule
        if (!known) return Error{"the recording", "has an unknown value: " + name + " = " + value};
    }
    return rules;
}

std::string filmOf(const sim::RecordingHeader& header, const std::string& own) {
    const auto film = header.settings.find("film");
    return film == header.settings.end() || film->second.find("..") != std::string::npos ? own : film->second;
}

bool needsFilmSpace(const sim::RecordingHeader& header) { return header.settings.contains(kFilmSpace); }

Status checkFilmSpace(const sim::RecordingHeader& header, const FilmSpace* space) {
    const auto recorded = header.settings.find(kFilmSpace);
    if (recorded == header.settings.end())
        return space ? Status(Error{"the recording", "was made in a film without distances"}) : Done{};
    if (!space)
        return Error{"the recording",
                     "was made in a film with distances, " + recorded->second + ", and none are known here"};
    if (nameOf(*space) != recorded->second)
        return Error{"the recording", "was made in a film with other distances: " + recorded->second +
                                          ", here " + nameOf(*space)};
    return Done{};
}

uint64_t Dive::stateHash() const {
    Hash hash;
    addState(hash, state_);
    return hash.value();
}

} // namespace shoal::game
