// From the state to what others see of it.
#include "game/Dive.h"
#include "game/Steering.h"
#include "game/World.h"

#include <cmath>

namespace shoal::game {

void World::fill(Snapshot& out) const {
    out.tick = totalTicks;
    out.time_s = static_cast<double>(tick) / sim::kTickRate_Hz;
    out.phase = phase;
    out.paused = paused;
    out.timeLeft_s =
        phase == Phase::Diving ? std::max(0.0f, file.duration_s - static_cast<float>(out.time_s)) : 0.0f;
    out.score = score;
    out.caught = caught;
    out.lost = lost;
    out.worldFromView = worldFromView;
    out.headWorld = headWorld;
    for (int h = 0; h < 2; ++h) {
        const Hand& hand = hands[h];
        HandView& view = out.hands[h];
        view.visible = hand.visible;
        view.grip = hand.grip;
        view.joints = hand.shown;
        view.holds = hand.holds;
        view.touching = hand.touching;
        view.holdProgress = hand.holds < 0 ? 0 : std::min(1.0f, fish[hand.holds].held_s / kHoldToCatch_s);
    }
    out.creatures.resize(fish.size() + (shark.present ? 1 : 0));
    const auto show = [&](size_t id, const auto& from, int heldBy) {
        CreatureView& view = out.creatures[id];
        view.id = static_cast<uint32_t>(id);
        view.species = from.species;
        view.position = from.position;
        view.worldFromBody = from.worldFromBody;
        view.velocity = from.velocity;
        view.length = species[from.species].length_m;
        view.motion = from.gait.motion;
        view.before = from.gait.before;
        view.blend = from.gait.blend;
        view.phase_s = from.gait.phase_s;
        view.shape = from.shape;
        view.heldBy = heldBy;
    };
    for (size_t i = 0; i < fish.size(); ++i) show(i, fish[i], fish[i].heldBy);
    if (shark.present) show(fish.size(), shark, -1);
}

void interpolate(const Snapshot& before, const Snapshot& after, float alpha, Snapshot& out) {
    constexpr float kJump_m = 0.6f; // in one tick: farther than anything swims or is carried
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
        c.worldFromBody = blended(a.worldFromBody, b.worldFromBody, alpha);
        c.phase_s = a.phase_s + (b.phase_s - a.phase_s) * alpha;
        const auto between = [&](float BodyShape::*part) {
            c.shape.*part = a.shape.*part + (b.shape.*part - a.shape.*part) * alpha;
        };
        for (auto part : {&BodyShape::beats, &BodyShape::amplitude, &BodyShape::bendLeft, &BodyShape::bendUp,
                          &BodyShape::finsDown})
            between(part);
        if (a.motion == b.motion) c.blend = a.blend + (b.blend - a.blend) * alpha;
    }
}

float reachAssist(const Snapshot& snapshot, const SpeciesTable& species, glm::vec3 rayView) {
    const glm::vec3 ray = snapshot.worldFromView * rayView;
    float best = -1, bestMiss = 1;
    for (const CreatureView& creature : snapshot.creatures) {
        if (species[creature.species].shark || creature.heldBy >= 0) continue;
        const glm::vec3 fromHead = creature.position - snapshot.headWorld;
        const float along = glm::dot(fromHead, ray);
        if (along < 0.3f || along > 1.5f) continue;
        // Within the body, or 4 degrees beside it.
        const float miss = glm::length(fromHead - ray * along) / (0.5f * creature.length + 0.07f * along);
        if (miss < bestMiss) {
            bestMiss = miss;
            best = along;
        }
    }
    return best;
}

} // namespace shoal::game
