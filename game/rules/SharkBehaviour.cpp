#include "game/rules/SharkBehaviour.h"

#include "game/rules/Hand.h"
#include "game/rules/Steering.h"
#include "game/rules/Swimmer.h"

#include <algorithm>

namespace shoal::game {

using State = Shark::State;

namespace {

glm::vec3 mouthOf(const Shark& shark, const SpeciesTable& species) {
    return shark.mouthPosition(species[shark.species].length_m);
}

int idOf(const SharkView& view) { return static_cast<int>(view.fish.size()); }

// The hand that holds a fish, or else the one nearest to its mouth; -1 if there is none to be seen.
int watchedHand(const Shark& shark, const SharkView& view) {
    int best = -1;
    float minimum = 1e9f;
    for (int h = 0; h < 2; ++h) {
        const Hand& hand = view.hands[h];
        if (!hand.visible) continue;
        const float distance = glm::distance(mouthOf(shark, view.species), hand.graspCentre) -
                               (hand.grasp.holds >= 0 ? 10.0f : 0.0f);
        if (distance < minimum) minimum = distance, best = h;
    }
    return best;
}

// A fish that struggles in a hand, -1 if none does.
int strugglingFish(const SharkView& view) {
    int struggling = -1;
    for (const Hand& hand : view.hands) {
        const int held = hand.grasp.holds;
        if (held >= 0 && !view.fish[held].counted && view.fish[held].held_s > 0.12f) struggling = held;
    }
    return struggling;
}

void decideCircling(Shark& shark, const SharkView& view, Events& events) {
    const auto& visits = view.dive.shark.visits_s;
    const bool due = shark.nextVisit < visits.size() && view.time_s >= visits[shark.nextVisit];
    if (due) ++shark.nextVisit;
    if (view.diveIsOver || !(due || (shark.interest > kTempted && shark.state_s > 8))) return;
    shark.set(State::Prowl);
    shark.threatRest_s = 0;
    shark.visit_s = view.dive.shark.visitLength_s;
    shark.interest = 0;
    events.push_back({.kind = EventKind::SharkNear, .creature = idOf(view), .position = shark.position});
}

void decideProwling(Shark& shark, const SharkView& view, int struggling) {
    shark.visit_s -= kDt;
    shark.threatRest_s -= kDt;
    const int hand = watchedHand(shark, view);
    const float room =
        hand < 0 ? 0 : glm::distance(mouthOf(shark, view.species), view.hands[hand].graspCentre);
    const bool holds = struggling >= 0 && hand >= 0 && view.hands[hand].grasp.holds == struggling;
    if (shark.visit_s <= 0)
        shark.set(State::Leave);
    else if (hand >= 0 && room > 1.3f * kThreatRoom_m && room < kThreatFrom_m &&
             (holds || shark.threatRest_s <= 0)) {
        shark.set(State::Threaten);
        shark.watched = hand;
        shark.aimed_s = 0;
    }
}

void decideThreatening(Shark& shark, const SharkView& view, int struggling) {
    shark.visit_s -= kDt;
    const Hand& hand = view.hands[shark.watched];
    const glm::vec3 to = hand.graspCentre - shark.position;
    const bool aimed = glm::dot(shark.forward, normalizedOr(to, shark.forward)) > kAimed;
    shark.aimed_s = aimed ? shark.aimed_s + kDt : 0;
    const float room = glm::distance(mouthOf(shark, view.species), hand.graspCentre);
    const bool held = struggling >= 0 && hand.grasp.holds == struggling;
    if (held && shark.aimed_s >= kAim_s && room < kStrikeFrom_m) {
        shark.prey = struggling;
        shark.set(State::Strike);
    } else if (!hand.visible || room < kThreatRoom_m || shark.state_s > kThreat_s) {
        shark.threatRest_s = kThreatRest_s;
        shark.set(shark.visit_s > 0 ? State::Prowl : State::Leave);
    }
}

void decideStriking(Shark& shark, const SharkView& view) {
    const Fish& prey = view.fish[shark.prey];
    if (prey.state == Fish::State::Held && !prey.counted && shark.state_s <= kStrikeTime_s) return;
    shark.prey = -1;
    shark.set(shark.visit_s > 0 ? State::Prowl : State::Leave);
}

void decideLeaving(Shark& shark, const SharkView& view) {
    if (placeOf(shark.position).radius > view.dive.shark.radius_m - 0.6f || shark.state_s > 15)
        shark.set(State::Circle);
}

void steal(Shark& shark, Fish& f, int id, Hands& hands, Score& score, Events& events) {
    const int h = f.heldBy;
    hands[h].grasp.holds = -1;
    f.heldBy = -1;
    f.state = Fish::State::Mouth;
    shark.mouth = id;
    shark.prey = -1;
    score.countLoss(f.species);
    events.push_back({EventKind::SharkSteal, id, h, f.position});
    shark.set(State::Leave);
    shark.visit_s = 0;
    shark.gait.set(Motion::Bite);
}

// The fish in its mouth lies across the jaws.
void carryInMouth(const Shark& shark, glm::vec3 mouth, Fish& f) {
    const glm::vec3 was = f.position;
    const glm::vec3 at = mouth - 0.05f * kUp;
    f.position += (at - f.position) * 0.3f;
    f.velocity = (f.position - was) / kDt;
    f.forward = leftOf(shark.forward) * shark.sense;
    f.worldFromBody = blended(f.worldFromBody, bodyTurn(f.forward, 0), 0.15f);
    f.speed = 0;
    f.gait.set(Motion::Struggle);
    f.gait.advance(1.2f);
    f.shape.beats += 4 * kDt;
    f.shape.amplitude += (0.1f - f.shape.amplitude) * (5 * kDt);
}

// It wriggles free far out and comes back to its band.
void breakFree(Shark& shark, Fish& f) {
    f.state = Fish::State::Dart;
    f.dart_s = 1.0f;
    f.frightRest_s = 2;
    f.uncatchable_s = kUncatchable_s;
    f.flee = normalizedOr({-f.position.x, 0, -f.position.z}, f.forward);
    shark.mouth = -1;
}

} // namespace

void decide(Shark& shark, const SharkView& view, Events& events) {
    shark.bumpRest_s = std::max(0.0f, shark.bumpRest_s - kDt);
    shark.state_s += kDt;
    const int struggling = strugglingFish(view);
    shark.interest = struggling >= 0 ? shark.interest + kDt : std::max(0.0f, shark.interest - 0.03f * kDt);
    switch (shark.state) {
    case State::Circle:
        return decideCircling(shark, view, events);
    case State::Prowl:
        return decideProwling(shark, view, struggling);
    case State::Threaten:
        return decideThreatening(shark, view, struggling);
    case State::Strike:
        return decideStriking(shark, view);
    case State::Leave:
        return decideLeaving(shark, view);
    }
}

void bite(Shark& shark, const SpeciesTable& species, Hands& hands, std::span<Fish> fish, Score& score,
          Events& events) {
    const glm::vec3 mouth = mouthOf(shark, species);
    if (shark.state == State::Strike && glm::distance(mouth, fish[shark.prey].position) < kJaws_m)
        steal(shark, fish[shark.prey], shark.prey, hands, score, events);
    if (shark.mouth >= 0) {
        Fish& f = fish[shark.mouth];
        carryInMouth(shark, mouth, f);
        if (placeOf(f.position).radius > kCarryTo_m || shark.state == State::Circle) breakFree(shark, f);
    }
    if (shark.gait.motion != Motion::Bite || shark.state_s > 0.6f)
        shark.gait.set(shark.state == State::Strike ? Motion::Lunge : Motion::Cruise);
    shark.gait.advance(std::clamp(shark.speed / species[shark.species].cruise_mps, 0.6f, 2.0f));
}

void bumpHands(Shark& shark, const SpeciesTable& species, std::span<const physics::Contact> own, Hands& hands,
               std::span<Fish> fish, Events& events) {
    for (const physics::Contact& contact : own) {
        const int h = contact.group;
        if (shark.bumpRest_s > 0) return;
        const bool striking = shark.state == State::Strike && hands[h].grasp.holds == shark.prey;
        if (striking) continue; // its jaws come first; see bite()
        shark.bumpRest_s = 0.8f;
        shark.visit_s = std::min(shark.visit_s, 1.0f); // it has had enough
        events.push_back({EventKind::SharkBump, static_cast<int>(fish.size()), h, contact.point,
                          partOfBone(contact.tag), contact.closingSpeed});
        if (hands[h].grasp.holds >= 0) drop(hands[h], h, species, fish, events);
    }
}

// How it swims.

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

constexpr float kSharkRockShy_m = 0.8f;    // room to what the film shows below which it turns away
constexpr float kNarrow_m = 2.8f;          // it does not circle on into less water than this...
constexpr float kWider_m = 0.5f;           // ...where there is so much more behind it
constexpr float kSharkGiveRoom_mps = 2.0f; // how fast a wall that comes nearer moves it at most

// In a tunnel it keeps to the open ends: it turns back where its circle leads on to a wall.
void turnBack(Shark& shark, const FilmMoment& film, glm::vec3 outward) {
    if (!film.known() || shark.state != State::Circle) return;
    constexpr float kAhead_m = 1.5f;
    const glm::vec3 along = glm::cross(kUp, outward) * (shark.sense * kAhead_m);
    const auto water = [&](glm::vec3 at) { return film.gap_m(at) + glm::length(at); };
    const float ahead = water(shark.position + along);
    if (ahead < kNarrow_m && water(shark.position - along) > ahead + kWider_m) shark.sense = -shark.sense;
}

void avoidRock(const Shark& shark, const Species& kind, const FilmMoment& film, Course& course) {
    if (!film.known()) return;
    const glm::vec3 soon = shark.position + 0.5f * kind.length_m * shark.forward;
    const float gap = film.gap_m(soon) - kind.bodyRadius_m;
    course.turn_radps *= 1 + 0.5f * film.keepOff(course.way, soon, gap, kSharkRockShy_m, 1);
}

// Towards the player, but never into the room around the eyes.
void keepInRoom(Shark& shark, const Species& kind, const FilmMoment& film, float most_m) {
    const float over = film.overshoot_m(capsuleOf(shark, kind));
    const float distance = glm::length(shark.position);
    const float spare = distance - kSharkEyeRoom_m;
    if (over > 0 && spare > 0)
        shark.position -= shark.position * (std::min({over, spare, most_m}) / distance);
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
    turnBack(shark, view.film, outward);
    Course course = courseOf(shark, kind, view, radius, outward);
    avoidRock(shark, kind, view.film, course);
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
    keepInRoom(shark, kind, view.film, kSharkGiveRoom_mps * kDt);
    keepClear(shark, kind, view.dive.floor_m, outward);
    shark.velocity = (shark.position - from) / kDt;
    shark.worldFromBody = bodyTurn(shark.forward, shark.bank);
    bendAndBeat(shark, kind, spin);
}

void startInRoom(Shark& shark, const SpeciesTable& species, const FilmMoment& film) {
    if (!shark.present) return;
    for (int round = 0; round < 4; ++round)
        keepInRoom(shark, species[shark.species], film, FilmSpace::kFar_m);
}

} // namespace shoal::game
