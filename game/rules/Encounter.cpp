#include "game/rules/Encounter.h"

#include "game/rules/Steering.h"
#include "game/rules/Swimmer.h"

namespace shoal::game {

// Distance at which its sound is placed, in the giant's true direction: a whale's voice carries far.
static constexpr float kHeardFrom_m = 1.5f;

void passBy(Passer& passer, int id, Score& score, const DiveContext& in, Events& events) {
    const EncounterPlan& plan = in.dive.encounter;
    if (plan.species < 0 || in.state.time_s() < plan.at_s || passer.state == Passer::State::Gone) return;
    const Species& kind = in.species[static_cast<size_t>(plan.species)];
    if (passer.state == Passer::State::ToCome) {
        passer.state = Passer::State::Passing;
        passer.position = plan.from;
        passer.forward = normalizedOr(plan.to - plan.from, {0, 0, 1});
        passer.speed = kind.cruise_mps;
        passer.worldFromBody = bodyTurn(passer.forward, 0);
        passer.shape.amplitude = tailAmplitude(1);
        score.species[static_cast<size_t>(plan.species)].touched = true;
        events.push_back({.kind = EventKind::Encounter,
                          .creature = id,
                          .position = kHeardFrom_m * normalizedOr(plan.from, kUp)});
    }
    passer.velocity = passer.forward * passer.speed;
    passer.position += passer.velocity * kDt;
    beatTail(passer, kind);
    passer.gait.advance(1);
    if (glm::dot(plan.to - passer.position, passer.forward) <= 0) passer.state = Passer::State::Gone;
}

} // namespace shoal::game
