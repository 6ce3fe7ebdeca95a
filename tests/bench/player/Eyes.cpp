#include "tests/bench/player/Eyes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace shoal::player {

namespace {

constexpr float kHandLength_m = 0.19f;
constexpr double kMotion_s = 0.1; // over which motion is seen

glm::vec2 project(glm::vec3 view) { return glm::vec2(view) * (kFocal_px / -view.z); }

} // namespace

const SeenFish* find(const Sight& sight, int id) {
    for (const SeenFish& fish : sight.fish)
        if (fish.id == id) return &fish;
    return nullptr;
}

void Eyes::look(const game::Snapshot& shown, const std::vector<bool>& isPrey, double time_s) {
    Sight sight;
    sight.time_s = time_s;
    const glm::quat viewFromWorld = glm::conjugate(shown.worldFromView);
    for (const game::CreatureView& creature : shown.creatures) {
        const glm::vec3 view = viewFromWorld * (creature.position - shown.headWorld);
        if (view.z > -0.15f) continue;
        const glm::vec2 at = project(view);
        if (std::fabs(at.x) > kHalfScreen_px.x || std::fabs(at.y) > kHalfScreen_px.y) continue;
        sight.fish.push_back({static_cast<int>(creature.id), creature.species, at,
                              creature.length * kFocal_px / -view.z, creature.catchable > 0.5f,
                              isPrey[static_cast<size_t>(creature.species)], creature.heldBy >= 0,
                              glm::length(view)});
    }
    const game::HandView& hand = shown.hands[1];
    const glm::vec3 view = viewFromWorld * (hands::graspCentre(hand.joints) - shown.headWorld);
    sight.hand_px = project(view);
    sight.handSize_px = kHandLength_m * kFocal_px / std::max(0.1f, -view.z);
    sight.handDistance_m = glm::length(view);
    sight.holds = hand.holds >= 0;
    sights_.push_back(std::move(sight));
    while (sights_.size() > 1 && sights_[1].time_s <= time_s - static_cast<double>(kReaction_s)) {
        if (sights_.front().time_s - before_.time_s > kMotion_s) before_ = sights_.front();
        sights_.pop_front();
    }
}

glm::vec2 Eyes::velocity_px(int id) const {
    const SeenFish* then = find(before_, id);
    const SeenFish* here = find(now(), id);
    const double elapsed_s = now().time_s - before_.time_s;
    if (!then || !here || elapsed_s < 0.02 || elapsed_s > 0.3) return glm::vec2(0);
    return (here->at_px - then->at_px) / static_cast<float>(elapsed_s);
}

} // namespace shoal::player
