#include "game/rules/ReachHelp.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::game {

namespace {

// Reach of hands that are tracked above a desk, a third of a metre ahead of its middle (see Mount in
// input/hands/HandTracker.h), so that mouse and hands have the same fish within reach. The wheel goes beyond.
constexpr float kNear_m = 0.3f, kFar_m = 1.3f;
// The cone around the ray, beyond the fish's own outline: full help up to the first angle, none from the
// second on. Tangents: 4 and 12 degrees.
constexpr float kFull = 0.07f, kNone = 0.21f;
constexpr float kKeptTo = 0.06f;      // advantage of the present target, a tangent...
constexpr float kNearerPer_m = 0.08f; // ...and of each metre nearer
constexpr float kLead_s = 0.15f;      // delay of the hand behind the fish that it follows

struct Seen {
    float beside; // angle between ray and body outline, tangent
    float along_m;
};

std::optional<Seen> seen(const CreatureView& creature, const Snapshot& now, const SpeciesTable& species,
                         glm::vec3 ray) {
    const Species& kind = species[static_cast<size_t>(creature.species)];
    const bool free = creature.heldBy < 0 && creature.gait.motion != Motion::Struggle;
    if (!isCatchable(kind) || !free || creature.hidden) return std::nullopt;
    const glm::vec3 fromHead = creature.position - now.headWorld;
    const float along = glm::dot(fromHead, ray);
    if (along < kNear_m || along > kFar_m) return std::nullopt;
    const float across = glm::length(fromHead - ray * along);
    return Seen{std::max(0.0f, across - 0.3f * creature.length) / along, along};
}

} // namespace

std::optional<float> ReachHelp::update(const Snapshot& now, const SpeciesTable& species, glm::vec3 rayView,
                                       float hand_m) {
    const glm::vec3 ray = now.worldFromView * rayView;
    std::optional<Seen> best;
    float bestCost = 0;
    int target = -1;
    for (const CreatureView& creature : now.creatures) {
        const auto here = seen(creature, now, species, ray);
        if (!here || here->beside >= kNone) continue;
        const int id = static_cast<int>(creature.id);
        const float cost = here->beside + kNearerPer_m * here->along_m - (id == target_ ? kKeptTo : 0);
        if (best && cost >= bestCost) continue;
        best = here;
        bestCost = cost;
        target = id;
    }
    target_ = target;
    if (!best) return std::nullopt;
    const CreatureView& creature = now.creatures[static_cast<size_t>(target)];
    const float goal =
        std::clamp(best->along_m + kLead_s * glm::dot(creature.velocity, ray), kNear_m, kFar_m);
    const float edge = std::clamp((kNone - best->beside) / (kNone - kFull), 0.0f, 1.0f);
    return hand_m + (goal - hand_m) * edge * edge * (3 - 2 * edge);
}

} // namespace shoal::game
