#include "game/rules/SharkBehaviour.h"
#include "game/rules/Steering.h"
#include "game/rules/Swimmer.h"

#include <algorithm>

namespace shoal::game {

using State = Shark::State;

namespace {

// Where it wants to go, how fast, and how fast it turns.
struct Course {
    glm::vec3 way{0};
    float speed_mps = 0;
    float turn_radps = 0;
};

// Along the circle that what it does asks for. A visit is a row of approaches: close past the player, wide
// out, and in again.
Course circle(const Shark& shark, const Species& kind, const SharkPlan& plan, float radius,
              glm::vec3 outward) {
    const bool visits = shark.state == State::Prowl;
    const bool wide = shark.threatRest_s > 0 && shark.threatRest_s < 0.6f * kThreatRest_s;
    const float goal = visits ? (wide ? kWide_m : plan.prowlRadius_m) : plan.radius_m;
    const float height = visits ? 0.5f * plan.height_m : plan.height_m;
    Course course;
    course.way = glm::cross(kUp, outward) * shark.sense +
                 outward * std::clamp(1.8f * (goal - radius), -1.4f, 1.4f) +
                 kUp * std::clamp(0.8f * (height - shark.position.y), -0.4f, 0.4f);
    course.speed_mps = kind.cruise_mps;
    course.turn_radps = kind.turn_radps;
    if (visits) {
        course.speed_mps = radius > goal + 0.8f ? 1.6f * kind.cruise_mps : 1.15f * kind.cruise_mps;
        course.turn_radps *= 1.4f;
    }
    return course;
}

// Turns first, then dashes; brakes so as to snap rather than ram.
Course strike(const Shark& shark, const Species& kind, glm::vec3 prey) {
    const float distance = glm::length(prey - shark.mouthPosition(kind.length_m));
    const glm::vec3 way = prey - shark.position;
    const float aimed = std::max(0.0f, glm::dot(shark.forward, normalizedOr(way, shark.forward)));
    const float speed =
        kind.dart_mps * std::clamp(aimed * aimed, 0.25f, 1.0f) * std::clamp(0.3f + distance, 0.4f, 1.0f);
    return {way, speed, 4};
}

Course courseOf(const Shark& shark, const Species& kind, const SharkView& view, float radius,
                glm::vec3 outward) {
    Course course = circle(shark, kind, view.dive.shark, radius, outward);
    switch (shark.state) {
    case State::Circle:
    case State::Prowl:
        break;
    case State::Threaten:
        return {view.hands[shark.watched].graspCentre - shark.position, 0.4f * kind.cruise_mps, 1.8f};
    case State::Strike:
        return strike(shark, kind, view.fish[shark.prey].position);
    case State::Leave:
        course.way += outward * 1.2f;
        course.speed_mps =
            glm::dot(shark.forward, outward) > 0.2f ? 1.7f * kind.cruise_mps : 0.6f * kind.cruise_mps;
        course.turn_radps *= 2.6f;
        break;
    }
    return course;
}

// Round the player's head, not through it.
void avoidHead(const Shark& shark, const Species& kind, Course& course) {
    const glm::vec3 nose = shark.mouthPosition(kind.length_m);
    const float room = glm::length(nose);
    const bool after = shark.state == State::Strike || shark.state == State::Threaten;
    if (room >= 1.1f || after) return;
    course.way += nose / std::max(room, 0.05f) * (2.5f * (1.1f - room));
    if (glm::dot(shark.forward, nose) < 0)
        course.speed_mps = std::min(course.speed_mps, 0.5f * kind.cruise_mps);
}

// Whatever happened: its axis keeps clear of the eyes, and its body of the ground.
void keepClear(Shark& shark, const Species& kind, float floor_m, glm::vec3 outward) {
    const float reach = 0.46f * kind.length_m;
    const float t = std::clamp(-glm::dot(shark.position, shark.forward), -reach, reach);
    const glm::vec3 nearest = shark.position + shark.forward * t;
    const float room = glm::length(nearest);
    if (room < kSharkEyeRoom_m)
        shark.position += normalizedOr(nearest, outward) * std::min(kSharkEyeRoom_m - room, 2.0f * kDt);
    shark.position.y = std::max(shark.position.y, floor_m + kind.bodyRadius_m + 0.05f);
}

// A shark that threatens: back arched, snout raised, pectoral fins lowered, the whole body swinging slowly
// and wide. Johnson & Nelson 1973, "Agonistic display in the gray reef shark".
void bendAndBeat(Shark& shark, const Species& kind, glm::vec3 desiredSpin) {
    const bool threatens = shark.state == State::Threaten;
    BodyShape& shape = shark.shape;
    beatTail(shark, kind, threatens ? 0.5f : 0.0f);
    const float amplitude = threatens ? 1.5f * kFullBeat : tailAmplitude(shark.speed / kind.cruise_mps);
    shape.amplitude = eased(shape.amplitude, amplitude, 4);
    shape.bendLeft = eased(shape.bendLeft, bendLeftFor(shark, desiredSpin, kind.length_m, kMaxBendLeft), 3);
    const float pitch = bendUpFor(shark, desiredSpin, kind.length_m, 0.2f);
    shape.bendUp = eased(shape.bendUp, threatens ? 0.4f : pitch, 5);
    shape.finsDown = eased(shape.finsDown, threatens ? 0.65f : 0.0f, 5);
}

} // namespace

void swimShark(Shark& shark, const SharkView& view) {
    const Species& kind = view.species[shark.species];
    const auto [radius, outward] = placeOf(shark.position);
    Course course = courseOf(shark, kind, view, radius, outward);
    avoidHead(shark, kind, course);

    const glm::vec3 goal = levelled(normalizedOr(course.way, shark.forward), 0.35f);
    const bool strikes = shark.state == State::Strike;
    const float turn = course.turn_radps;
    const glm::vec3 spin = turnSmoothly(shark.forward, shark.spin, goal, strikes ? 8.0f : 2.5f * turn, turn,
                                        strikes ? 40.0f : 8.0f * turn, kDt);
    shark.forward = levelled(shark.forward, 0.4f);
    bankIntoTurn(shark, 0.3f, 0.6f, 3);
    shark.speed =
        towards(shark.speed, course.speed_mps, (course.speed_mps > shark.speed ? 5.0f : 3.0f) * kDt);

    const glm::vec3 from = shark.position;
    shark.position += shark.forward * shark.speed * kDt;
    keepClear(shark, kind, view.dive.floor_m, outward);
    shark.velocity = (shark.position - from) / kDt;
    shark.worldFromBody = bodyTurn(shark.forward, shark.bank);
    bendAndBeat(shark, kind, spin);
}

} // namespace shoal::game
