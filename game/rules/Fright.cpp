#include "game/rules/Fright.h"

#include "game/rules/Steering.h"

namespace shoal::game {

void startle(Fish& f, int id, glm::vec3 from, Random& random, EventSink& events) {
    if (!f.free()) return;
    // Away from the danger, rather along than up or down, and not through the player.
    glm::vec3 away = normalizedOr(f.position - from, f.forward);
    const glm::vec3 outward = normalizedOr({f.position.x, 0, f.position.z}, {0, 0, -1});
    away =
        normalizedOr(glm::vec3(away.x, 0.4f * away.y, away.z) + outward * 0.5f + f.forward * 0.3f, f.forward);
    f.flee = away;
    f.dart_s = 0.8f + 0.5f * random.unit();
    f.nervous_s = 0;
    if (f.frightRest_s > 0) return;
    f.state = Fish::State::Dart;
    f.frightRest_s = 1.5f;
    events.emit(events::Startle{id, f.position});
}

void frightenByHands(const Hands& hands, const SpeciesTable& species, std::span<Fish> fish, Random& random,
                     EventSink& events) {
    for (const Hand& hand : hands) {
        if (!hand.solid) continue;
        for (size_t i = 0; i < fish.size(); ++i) {
            Fish& f = fish[i];
            if (f.state != Fish::State::Cruise || f.frightRest_s > 0) continue;
            const float shyness = species[f.species].shyness;
            const glm::vec3 apart = f.position - hand.graspCentre;
            const float distance = glm::length(apart);
            if (distance > 0.8f || distance < 1e-4f) continue;
            // A hand coming on at 1.2 m/s is noticed at 0.23 m, at 3 m/s at 0.5 m.
            const float closing = glm::dot(hand.calmVelocity - f.velocity, apart / distance);
            if (closing < 1.2f || distance > shyness * (0.05f + 0.15f * closing)) continue;
            startle(f, static_cast<int>(i), hand.graspCentre, random, events);
        }
    }
}

} // namespace shoal::game
