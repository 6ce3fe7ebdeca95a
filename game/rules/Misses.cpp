#include "game/rules/Misses.h"

#include "game/rules/Intent.h"
#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

Miss missOf(const Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    constexpr float kCone = 0.12f, kBeside_m = 0.12f; // cone around the line of sight: tangent, radius at eye
    constexpr float kFarthest_m = 3;
    const glm::vec3 sight = normalizedOr(hand.graspCentre - in.head(), {0, 0, -1});
    const Fish* meant = nullptr;
    float nearest = 1, depth = 0; // depth: distance beyond the hand, metres
    glm::vec3 beside(0);
    for (const Fish& f : fish) {
        if (!f.free() || f.uncatchable_s > 0) continue;
        const glm::vec3 fromHead = f.position - in.head();
        const float along = glm::dot(fromHead, sight);
        if (along < 0.2f || along > kFarthest_m) continue;
        const glm::vec3 across = fromHead - along * sight;
        const float room = kBeside_m + 0.5f * in.kindOf(f).length_m + kCone * along;
        const float beyond = along - glm::distance(hand.graspCentre, in.head());
        // Depth counts a little: of two fish beside the line the nearer one was meant.
        const float cost = glm::length(across) / room + 0.15f * std::fabs(beyond);
        if (cost >= nearest || glm::length(across) > room) continue;
        if (in.hides(f.position)) continue;
        nearest = cost;
        meant = &f;
        depth = beyond;
        beside = across;
    }
    if (!meant) return Miss::Nothing;
    if (hand.intent.fastest_mps > kFastHand_mps || meant->state == Fish::State::Dart) return Miss::TooFast;
    const float reach = kGraspRadius_m + in.kindOf(*meant).bodyRadius_m;
    if (depth > reach) return Miss::TooFar;
    const bool leaves = glm::dot(meant->velocity, beside) > 0;
    if (depth < -reach || (leaves && glm::length(beside) > reach)) return Miss::Behind;
    return Miss::TooEarly;
}

EventKind eventOf(Miss miss) {
    constexpr auto kFirst = static_cast<int>(EventKind::Miss); // both enumerations have the same order
    return static_cast<EventKind>(kFirst + std::max(0, static_cast<int>(miss) - 1));
}

} // namespace shoal::game
