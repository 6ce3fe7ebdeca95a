#include "game/app/GuideAnimal.h"

#include <algorithm>

namespace shoal::app {

constexpr float kFar_m = 0.8f;                   // distance from the viewer: no rock is so near
constexpr float kAside = 0.36f;                  // of half the picture's width, from its middle
constexpr float kSize = 0.9f;                    // of half the picture's width...
constexpr float kWidest = 1.7f;                  // ...which counts as at most this times half its height
constexpr float kYaw = 1.2f, kYaw_radps = -0.6f; // at first to the right; it then turns towards the viewer
constexpr float kBeat_Hz = 0.8f, kSwing = 0.05f; // of the tail, body lengths

const game::Snapshot& GuideAnimal::show(const game::Snapshot& viewer, int species, const game::Species& kind,
                                        float extent, glm::vec2 tanHalf, float dt_s, bool turns) {
    shown_.creatures.resize(1);
    game::CreatureView& animal = shown_.creatures[0];
    age_s_ = animal.species == species ? age_s_ + dt_s : 0;
    shown_.time_s = viewer.time_s;
    shown_.headWorld = viewer.headWorld;
    shown_.worldFromView = viewer.worldFromView;
    animal.species = species;
    animal.position =
        viewer.headWorld + viewer.worldFromView * glm::vec3(kAside * tanHalf.x * kFar_m, 0, -kFar_m);
    animal.worldFromBody =
        viewer.worldFromView * glm::angleAxis(kYaw + (turns ? kYaw_radps * age_s_ : 0), glm::vec3(0, 1, 0));
    animal.length = kSize * kFar_m * std::min(tanHalf.x, kWidest * tanHalf.y) / extent;
    animal.gait.motion = kind.thing != game::Thing::None ? game::Motion::Detached
                         : kind.shark                    ? game::Motion::Cruise
                                                         : game::Motion::Swim;
    animal.gait.phase_s = age_s_;
    animal.shape.beats = kBeat_Hz * age_s_;
    animal.shape.amplitude = kSwing;
    return shown_;
}

} // namespace shoal::app
