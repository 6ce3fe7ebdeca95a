// Makes the snapshots of a dive and interpolates between them.
#include "game/rules/Dive.h"

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
    view.holdProgress = view.holds < 0 ? 0 : std::min(1.0f, fish[view.holds].hold.time_s / kHoldToCatch_s);
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
    out.combo = s.score.combo();
    out.bestCombo = s.score.bestCombo;
    out.tally = s.score.species;
    out.goals.resize(dive.goals.size());
    for (size_t i = 0; i < dive.goals.size(); ++i)
        out.goals[i] = {progressOf(dive.goals[i], s.score), s.score.reached[i]};
    out.worldFromView = s.view.worldFromView;
    out.headWorld = s.view.headWorld;
    for (size_t h = 0; h < s.hands.size(); ++h) showHand(s.hands[h], s.fish, out.hands[h]);
    const bool passing = s.passer.state == Passer::State::Passing;
    out.creatures.resize(static_cast<size_t>(passerId()) + (passing ? 1 : 0));
    const auto show = [&](size_t id, const Swimmer& from, int species) -> CreatureView& {
        CreatureView& view = out.creatures[id];
        view = {.id = static_cast<uint32_t>(id),
                .species = species,
                .position = from.position,
                .worldFromBody = from.worldFromBody,
                .velocity = from.velocity,
                .length = files_.species[species].length_m,
                .gait = from.gait,
                .shape = from.shape};
        return view;
    };
    const DiveContext in = context();
    for (size_t i = 0; i < s.fish.size(); ++i) {
        const Fish& fish = s.fish[i];
        CreatureView& view = show(i, fish, fish.species);
        view.heldBy = fish.heldBy;
        view.catchable = fish.catchable;
        view.hidden = in.hides(fish.position);
    }
    if (s.shark.present) show(s.fish.size(), s.shark, s.shark.species);
    if (passing) show(static_cast<size_t>(passerId()), s.passer, dive.encounter.species);
}

void interpolate(const Snapshot& before, const Snapshot& after, float alpha, Snapshot& out) {
    constexpr float kJump_m = 0.6f; // movement in one tick beyond anything that swims or is carried
    out = after;                    // keeps out's memory: no allocation once it has grown
    if (before.creatures.size() != after.creatures.size() || after.tick != before.tick + 1 ||
        after.time_s < before.time_s)
        return;
    // Both set `to`, the value after, to the one between it and `from`.
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

} // namespace shoal::game
