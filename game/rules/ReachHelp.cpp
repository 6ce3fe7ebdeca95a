#include "game/rules/ReachHelp.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::game {

namespace {

// Reach of hands that are tracked above a desk, a third of a metre ahead of its middle (see Mount in
// input/hands/HandTracker.h), so that mouse and hands have the same fish within reach. The wheel goes beyond.
constexpr float kNear_m = 0.3f, kFar_m = 1.3f;
// Angles between the ray and the fish's outline, as tangents: full help up to the first (4 degrees), none
// from the second on (12 degrees).
constexpr float kFull = 0.07f, kNone = 0.21f;
constexpr float kKeptTo = 0.06f;      // bonus of the present target, a tangent...
constexpr float kNearerPer_m = 0.08f; // ...and bonus for each metre that a fish is nearer
constexpr float kLead_s = 0.15f;      // look-ahead that makes up for the hand's delay behind the fish

} // namespace

std::optional<float> ReachHelp::update(const Snapshot& now, const SpeciesTable& species, glm::vec3 rayView,
                                       float hand_m) {
    const glm::vec3 ray = now.worldFromView * rayView;
    const CreatureView* target = nullptr;
    float leastCost = 0, targetBeside = 0, targetAlong_m = 0; // beside: angle from ray to outline, a tangent
    for (const CreatureView& creature : now.creatures) {
        const bool free = creature.heldBy < 0 && creature.gait.motion != Motion::Struggle;
        if (!isCatchable(species[creature.species]) || !free || creature.hidden) continue;
        const glm::vec3 fromHead = creature.position - now.headWorld;
        const float along_m = glm::dot(fromHead, ray);
        if (along_m < kNear_m || along_m > kFar_m) continue;
        const float across_m = glm::length(fromHead - ray * along_m);
        const float beside = std::max(0.0f, across_m - 0.3f * creature.length) / along_m;
        const bool kept = static_cast<int>(creature.id) == target_;
        const float cost = beside + kNearerPer_m * along_m - (kept ? kKeptTo : 0);
        if (beside >= kNone || (target && cost >= leastCost)) continue;
        target = &creature;
        leastCost = cost;
        targetBeside = beside;
        targetAlong_m = along_m;
    }
    target_ = target ? static_cast<int>(target->id) : -1;
    if (!target) return std::nullopt;
    const float goal = std::clamp(targetAlong_m + kLead_s * glm::dot(target->velocity, ray), kNear_m, kFar_m);
    const float edge = std::clamp((kNone - targetBeside) / (kNone - kFull), 0.0f, 1.0f);
    return hand_m + (goal - hand_m) * edge * edge * (3 - 2 * edge);
}

} // namespace shoal::game
