// Makes the snapshots of a dive and interpolates between them.
#include "game/rules/Dive.h"
#include "game/rules/Steering.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {

void showHand(const Hand& hand, const std::vector<Fish>& fish, HandView& view) {
    view.visible = hand.visible;
    view.grip = hand.grip;
    view.joints = hand.fingers.shown;
    view.holds = hand.grasp.holds;
    view.touching = hand.touching;
    view.lastMiss = hand.lastMiss;
    view.sinceMiss_s = hand.sinceMiss_s;
    view.stung_s = hand.stung_s;
    view.holdProgress = view.holds < 0 ? 0 : std::min(1.0f, fish[view.holds].held_s / kHoldToCatch_s);
}

void showCreature(const Swimmer& from, size_t id, int species, float length_m, int heldBy,
                  CreatureView& view) {
    view.id = static_cast<uint32_t>(id);
    view.species = species;
    view.position = from.position;
    view.worldFromBody = from.worldFromBody;
    view.velocity = from.velocity;
    view.length = length_m;
    view.gait = from.gait;
    view.shape = from.shape;
    view.heldBy = heldBy;
}

void showScore(const Score& score, const std::vector<Goal>& goals, Snapshot& out) {
    out.combo = score.combo();
    out.bestCombo = score.bestCombo;
    out.tally = score.species;
    out.goals.resize(goals.size());
    for (size_t i = 0; i < goals.size(); ++i) out.goals[i] = {progressOf(goals[i], score), score.reached[i]};
}

// Returns the weight of a mark at a time: 1 within it, down to 0 over kRamp_s on both sides.
double within(const VideoMark& mark, double videoLength_s, double time_s) {
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

} // namespace

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
    showScore(s.score, dive.goals, out);
    out.worldFromView = s.view.worldFromView;
    out.headWorld = s.view.headWorld;
    for (size_t h = 0; h < s.hands.size(); ++h) showHand(s.hands[h], s.fish, out.hands[h]);
    const bool passing = s.passer.state == Passer::State::Passing;
    out.creatures.resize(static_cast<size_t>(passerId()) + (passing ? 1 : 0));
    const auto show = [&](size_t id, const Swimmer& from, int species, int heldBy) {
        showCreature(from, id, species, files_.species[species].length_m, heldBy, out.creatures[id]);
    };
    const FilmMoment now = film();
    for (size_t i = 0; i < s.fish.size(); ++i) {
        show(i, s.fish[i], s.fish[i].species, s.fish[i].heldBy);
        out.creatures[i].catchable = s.fish[i].catchable;
        out.creatures[i].catchableBy = s.fish[i].catchableBy;
        out.creatures[i].hidden = now.hides(s.view.headWorld, s.fish[i].position);
    }
    if (s.shark.present) show(s.fish.size(), s.shark, s.shark.species, -1);
    if (passing) show(static_cast<size_t>(passerId()), s.passer, dive.encounter.species, -1);
}

void interpolate(const Snapshot& before, const Snapshot& after, float alpha, Snapshot& out) {
    constexpr float kJump_m = 0.6f; // movement in one tick beyond anything that swims or is carried
    out = after;                    // keeps out's memory: no allocation once it has grown
    if (before.creatures.size() != after.creatures.size() || after.tick != before.tick + 1 ||
        after.time_s < before.time_s)
        return;
    out.time_s = before.time_s + (after.time_s - before.time_s) * static_cast<double>(alpha);
    out.timeLeft_s = before.timeLeft_s + (after.timeLeft_s - before.timeLeft_s) * alpha;
    out.worldFromView = blended(before.worldFromView, after.worldFromView, alpha);
    out.headWorld = glm::mix(before.headWorld, after.headWorld, alpha);
    for (int h = 0; h < 2; ++h) {
        const HandView& a = before.hands[h];
        const HandView& b = after.hands[h];
        if (!a.visible || !b.visible) continue;
        out.hands[h].grip = a.grip + (b.grip - a.grip) * alpha;
        for (int j = 0; j < hands::kJointCount; ++j) {
            out.hands[h].joints[j].position = glm::mix(a.joints[j].position, b.joints[j].position, alpha);
            out.hands[h].joints[j].orientation =
                blended(a.joints[j].orientation, b.joints[j].orientation, alpha);
        }
    }
    for (size_t i = 0; i < out.creatures.size(); ++i) {
        const CreatureView& a = before.creatures[i];
        const CreatureView& b = after.creatures[i];
        if (glm::distance(a.position, b.position) > kJump_m) continue;
        CreatureView& c = out.creatures[i];
        c.position = glm::mix(a.position, b.position, alpha);
        c.velocity = glm::mix(a.velocity, b.velocity, alpha);
        c.catchable = a.catchable + (b.catchable - a.catchable) * alpha;
        c.worldFromBody = blended(a.worldFromBody, b.worldFromBody, alpha);
        c.gait.phase_s = a.gait.phase_s + (b.gait.phase_s - a.gait.phase_s) * alpha;
        const auto between = [&](float BodyShape::*part) {
            c.shape.*part = a.shape.*part + (b.shape.*part - a.shape.*part) * alpha;
        };
        for (auto part : {&BodyShape::beats, &BodyShape::amplitude, &BodyShape::bendLeft, &BodyShape::bendUp,
                          &BodyShape::finsDown})
            between(part);
        if (a.gait.motion == b.gait.motion)
            c.gait.blend = a.gait.blend + (b.gait.blend - a.gait.blend) * alpha;
    }
}

} // namespace shoal::game
