#include "game/rules/SharkBehaviour.h"

#include "engine/math/Trigonometry.h"
#include "game/rules/Hand.h"
#include "game/rules/Steering.h"
#include "game/rules/Swimmer.h"

#include <algorithm>
#include <numbers>

namespace shoal::game {

using State = Shark::State;

float openRadius(glm::vec3 place, const SharkPlan& plan, const Species& kind, const FilmMoment& film) {
    if (!film.known()) return plan.radius_m;
    const glm::vec3 outward = placeOf(place).outward, along = glm::cross(kUp, outward) * kind.bodyHalf_m;
    float fits = kSharkEyeRoom_m, tooFar = plan.radius_m + 0.1f;
    for (int halving = 0; halving < 6; ++halving) { // to 6 cm
        const float radius = 0.5f * (fits + tooFar);
        const glm::vec3 at = outward * radius + kUp * plan.height_m;
        (film.overshoot_m({at - along, at + along, kind.bodyRadius_m}) > 0 ? tooFar : fits) = radius;
    }
    return std::min(fits, plan.radius_m);
}

namespace {

float openRadius(glm::vec3 place, const SharkView& view, const FilmMoment& film) {
    return openRadius(place, view.dive.shark, view.species[view.dive.shark.species], film);
}
float openRadius(glm::vec3 place, const SharkView& view) { return openRadius(place, view, view.film); }

// Returns the lesser openRadius() of the near and the later future.
float soonOpen(glm::vec3 place, const SharkView& view) {
    return std::min(openRadius(place, view, view.filmSoon), openRadius(place, view, view.filmLater));
}

glm::vec3 mouthOf(const Shark& shark, const SpeciesTable& species) {
    return shark.mouthPosition(species[shark.species].length_m);
}

int idOf(const SharkView& view) { return static_cast<int>(view.fish.size()); }

// Returns the hand that holds a fish, or else the one nearest to its mouth; -1 if none is visible.
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

// Returns how much nearer its mouth may come while it threatens that hand: it keeps its distance from the
// hand and from the player's head. Negative: it is too near.
float threatSpare(const Shark& shark, const SharkView& view, int hand) {
    const glm::vec3 mouth = mouthOf(shark, view.species);
    return std::min(glm::distance(mouth, view.hands[hand].graspCentre) - kThreatRoom_m,
                    glm::length(mouth) - kSharkApart_m);
}

// Returns a fish that struggles in a hand, -1 if none does.
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
    shark.bumpRest_s = std::max(shark.bumpRest_s, kNotice_s);
    events.push_back({.kind = EventKind::SharkNear, .creature = idOf(view), .position = shark.position});
}

void decideProwling(Shark& shark, const SharkView& view, int struggling) {
    if (openRadius(shark.position, view) > kVisitRoom_m) shark.visit_s -= kDt; // else it waits for room
    shark.threatRest_s -= kDt;
    const int hand = watchedHand(shark, view);
    const float away =
        hand < 0 ? 0 : glm::distance(mouthOf(shark, view.species), view.hands[hand].graspCentre);
    const bool holds = struggling >= 0 && hand >= 0 && view.hands[hand].grasp.holds == struggling;
    if (shark.visit_s <= 0)
        shark.set(State::Leave);
    else if (hand >= 0 && away < kThreatFrom_m && threatSpare(shark, view, hand) > 0.2f &&
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
    const float away = glm::distance(mouthOf(shark, view.species), hand.graspCentre);
    const bool held = struggling >= 0 && hand.grasp.holds == struggling;
    if (held && shark.aimed_s >= kAim_s && away < kStrikeFrom_m) {
        shark.prey = struggling;
        shark.set(State::Strike);
    } else if (!hand.visible || threatSpare(shark, view, shark.watched) < -0.3f ||
               shark.state_s > kThreat_s) {
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

// Returns whether it is on its circle, or as far from the player as the film lets it swim there.
bool isFarOut(const Shark& shark, const SharkView& view) {
    return placeOf(shark.position).radius > openRadius(shark.position, view) - kFarOut_m;
}

void decideLeaving(Shark& shark, const SharkView& view) {
    if (isFarOut(shark, view) || shark.state_s > 15) shark.set(State::Circle);
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

// Moves the fish in its mouth with it, across the jaws.
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

// Frees the fish in its mouth, which flees towards its band.
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

void bite(Shark& shark, const SharkView& view, Hands& hands, std::span<Fish> fish, Score& score,
          Events& events) {
    const SpeciesTable& species = view.species;
    const glm::vec3 mouth = mouthOf(shark, species);
    if (shark.state == State::Strike && glm::distance(mouth, fish[shark.prey].position) < kJaws_m)
        steal(shark, fish[shark.prey], shark.prey, hands, score, events);
    if (shark.mouth >= 0) {
        Fish& f = fish[shark.mouth];
        carryInMouth(shark, mouth, f);
        if (isFarOut(shark, view) || shark.state == State::Circle) breakFree(shark, f);
    }
    if (shark.gait.motion != Motion::Bite || shark.state_s > 0.6f)
        shark.gait.set(shark.state == State::Strike ? Motion::Lunge : Motion::Cruise);
    shark.gait.advance(std::clamp(shark.speed / species[shark.species].cruise_mps, 0.6f, 2.0f));
}

void bumpHands(Shark& shark, const SpeciesTable& species, std::span<const physics::Contact> own, Hands& hands,
               std::span<Fish> fish, Events& events) {
    // A shark that a wall or the room around the eyes pushes along a hand only brushes it: no bump.
    constexpr float kMovedAside_mps = 0.25f, kBrushRest_s = 0.5f;
    if (!own.empty() && glm::distance(shark.velocity, shark.forward * shark.speed) > kMovedAside_mps)
        shark.bumpRest_s = std::max(shark.bumpRest_s, kBrushRest_s);
    for (const physics::Contact& contact : own) {
        const int h = contact.group;
        if (shark.bumpRest_s > 0) return;
        const bool striking = shark.state == State::Strike && hands[h].grasp.holds == shark.prey;
        if (striking) continue; // its jaws come first; see bite()
        shark.bumpRest_s = kBumpRest_s;
        shark.visit_s = std::min(shark.visit_s, 1.0f); // the visit ends soon after a bump
        events.push_back({EventKind::SharkBump, static_cast<int>(fish.size()), h, contact.point,
                          partOfBone(contact.tag), contact.closingSpeed});
        if (hands[h].grasp.holds >= 0) drop(hands[h], h, species, fish, events);
    }
}

// Swimming.

namespace {

constexpr float kNarrow_m = 1.5f;          // radius of a circle that passes the player too near
constexpr float kSharkRockShy_m = 0.8f;    // gap to the film's surfaces below which it turns away
constexpr float kHandShy_m = 0.8f;         // distance of its nose from hands in films with distances
constexpr float kRoomy_m = 2.8f;           // it turns back from less room than this ahead...
constexpr float kWider_m = 0.5f;           // ...where the other way has so much more
constexpr float kSharkGiveRoom_mps = 3.0f; // greatest speed at which an approaching wall moves it

// The way, the speed and the turning rate that it wants.
struct Course {
    glm::vec3 way{0};
    float speed_mps = 0;
    float turn_radps = 0;
};

// Returns the course along its state's circle. A visit is a row of approaches: close past the player, wide
// out, and in again.
Course circle(const Shark& shark, const Species& kind, const SharkView& view, float radius,
              glm::vec3 outward) {
    const SharkPlan& plan = view.dive.shark;
    const bool visits = shark.state == State::Prowl;
    const bool wide = shark.threatRest_s > 0 && shark.threatRest_s < 0.6f * kThreatRest_s;
    const float open = std::min(openRadius(shark.position, view), soonOpen(shark.position, view));
    const float goal = std::min(visits ? (wide ? kWide_m : plan.prowlRadius_m) : plan.radius_m,
                                std::max(open, kSharkApart_m + 0.2f));
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
    if (open < kNarrow_m) course.speed_mps = 2 * kind.cruise_mps; // it hurries out of narrow places
    return course;
}

// Returns the course of a strike: it turns, then dashes, and brakes so as to snap rather than ram.
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
    Course course = circle(shark, kind, view, radius, outward);
    switch (shark.state) {
    case State::Circle:
    case State::Prowl:
        break;
    case State::Threaten:
        return {view.hands[shark.watched].graspCentre - shark.position,
                0.4f * kind.cruise_mps * std::clamp(2 * threatSpare(shark, view, shark.watched), 0.0f, 1.0f),
                1.8f};
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

// Steers it around the player's head and hands.
void avoidPlayer(const Shark& shark, const Species& kind, const SharkView& view, Course& course) {
    if (shark.state == State::Strike || shark.state == State::Threaten) return;
    const glm::vec3 nose = shark.mouthPosition(kind.length_m);
    const auto avoid = [&](glm::vec3 from, float shy_m, float least_mps) {
        const glm::vec3 apart = nose - from;
        const float distance = glm::length(apart);
        if (distance >= shy_m) return;
        course.way += apart / std::max(distance, 0.05f) * (2.5f * (shy_m - distance));
        if (glm::dot(shark.forward, apart) < 0)
            course.speed_mps = std::clamp(distance - 0.5f * shy_m, least_mps, course.speed_mps);
    };
    avoid(glm::vec3(0), kSharkApart_m + 0.15f, 0.5f * kind.cruise_mps);
    if (!view.film.known()) return;
    for (const Hand& hand : view.hands)
        if (hand.visible) avoid(hand.graspCentre, kHandShy_m, 0);
}

// Returns the open radius soon at a bearing, at most kSharkApart_m where a hand leaves no way past it.
float roomAt(glm::vec3 outward, const SharkView& view) {
    const float open = soonOpen(outward, view);
    for (const Hand& hand : view.hands) {
        const Place at = placeOf(hand.graspCentre);
        const bool beside = hand.visible && glm::dot(at.outward, outward) > 0.7f;
        if (beside && open < at.radius + kHandShy_m) return std::min(open, kSharkApart_m);
    }
    return open;
}

// Returns the most room soon at three bearings to one side, less what the narrowest on the way lacks.
float roomTowards(const Shark& shark, const SharkView& view, float sense) {
    float most = 0, passed = view.dive.shark.radius_m;
    glm::vec3 outward = placeOf(shark.position).outward;
    for (int step = 1; step <= 3; ++step) {
        outward = normalizedOr(outward + 0.65f * sense * glm::cross(kUp, outward), outward); // 33 degrees
        const float room = roomAt(outward, view);
        passed = std::min(passed, room);
        most = std::max(most, room - std::max(0.0f, kNarrow_m - passed));
    }
    return most;
}

// Turns it back where its circle leads on to a wall and the other way has more room.
void turnBack(Shark& shark, const SharkView& view) {
    if (!view.film.known() || shark.state == State::Threaten || shark.state == State::Strike) return;
    const float ahead = roomTowards(shark, view, shark.sense);
    if (ahead < kRoomy_m && roomTowards(shark, view, -shark.sense) > ahead + kWider_m)
        shark.sense = -shark.sense;
}

void avoidRock(const Shark& shark, const Species& kind, const FilmMoment& film, Course& course) {
    if (!film.known()) return;
    const glm::vec3 soon = shark.position + 0.5f * kind.length_m * shark.forward;
    const float gap = film.gap_m(soon) - kind.bodyRadius_m;
    course.turn_radps *= 1 + 0.5f * film.keepOff(course.way, soon, gap, kSharkRockShy_m, 1);
}

// Moves the shark out of the film's surfaces, towards the player but never into the room around the eyes.
void keepInRoom(Shark& shark, const Species& kind, const FilmMoment& film, float most_m) {
    const float over = film.overshoot_m(capsuleOf(shark, kind));
    const float distance = glm::length(shark.position);
    const float spare = distance - kSharkEyeRoom_m;
    if (over > 0 && spare > 0)
        shark.position -= shark.position * (std::min({over, spare, most_m}) / distance);
}

// Moves its axis out of the room around the eyes.
void keepFromEyes(Shark& shark, const Species& kind, float room_m, glm::vec3 outward) {
    const float reach = 0.46f * kind.length_m;
    const float t = std::clamp(-glm::dot(shark.position, shark.forward), -reach, reach);
    const glm::vec3 nearest = shark.position + shark.forward * t;
    const float missing = room_m - glm::length(nearest);
    if (missing > 0)
        shark.position += normalizedOr(nearest, outward) * std::min(missing, kSharkGiveRoom_mps * kDt);
}

// Bends body and tail. A threatening shark arches its back, raises its snout, lowers its pectoral fins and
// swings slowly and wide: Johnson & Nelson 1973, "Agonistic display in the gray reef shark".
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
    turnBack(shark, view);
    Course course = courseOf(shark, kind, view, radius, outward);
    avoidRock(shark, kind, view.film, course);
    avoidPlayer(shark, kind, view, course);

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
    if (!strikes) keepFromEyes(shark, kind, kSharkApart_m, outward);
    keepInRoom(shark, kind, view.film, kSharkGiveRoom_mps * kDt);
    keepFromEyes(shark, kind, kSharkEyeRoom_m, outward);
    shark.position.y = std::max(shark.position.y, view.dive.floor_m + kind.bodyRadius_m + 0.05f);
    shark.velocity = (shark.position - from) / kDt;
    shark.worldFromBody = bodyTurn(shark.forward, shark.bank);
    bendAndBeat(shark, kind, spin);
}

void startInRoom(Shark& shark, const SharkView& view) {
    if (!shark.present) return;
    // Takes the first of sixteen bearings with a whole circle's room, or else the one with most.
    constexpr int kBearings = 16;
    const glm::quat turn = math::rotationAbout(kUp, 2 * std::numbers::pi_v<float> / kBearings);
    float most = 0;
    glm::vec3 outward = placeOf(shark.position).outward, best = outward;
    for (int i = 0; i < kBearings && most < view.dive.shark.radius_m; ++i, outward = turn * outward)
        if (const float open = openRadius(outward, view); open > most) most = open, best = outward;
    startCircling(shark, best * most + kUp * view.dive.shark.height_m, best, shark.sense, shark.speed);
}

} // namespace shoal::game
