#include "game/rules/SharkBehaviour.h"

#include "engine/math/Trigonometry.h"
#include "game/rules/FishBehaviour.h"
#include "game/rules/Grasping.h"

#include <algorithm>
#include <numbers>

namespace shoal::game {

using State = Shark::State;

float openRadius(glm::vec3 place, const DiveContext& in, float ahead_s) {
    const SharkPlan& plan = in.dive.shark;
    if (!in.film.known()) return plan.radius_m;
    const Species& kind = in.species[plan.species];
    const FilmMoment film = in.film.as(FilmSpace::Room::Shark, ahead_s);
    const glm::vec3 outward = placeOf(place).outward, along = glm::cross(kUp, outward) * kind.bodyHalf_m;
    float fits = kSharkEyeRoom_m, tooFar = plan.radius_m + 0.1f;
    for (int halving = 0; halving < 6; ++halving) { // accurate to 6 cm for a radius of 4.2 m
        const float radius = 0.5f * (fits + tooFar);
        const glm::vec3 at = outward * radius + kUp * plan.height_m;
        (film.overshoot_m({at - along, at + along, kind.bodyRadius_m}, 0) > 0 ? tooFar : fits) = radius;
    }
    return std::min(fits, plan.radius_m);
}

// Returns the smaller of the two values of openRadius() at kSoon_s and at kLater_s from now.
static float futureOpenRadius(glm::vec3 place, const DiveContext& in) {
    return std::min(openRadius(place, in, kSoon_s), openRadius(place, in, kLater_s));
}

glm::vec3 mouthOf(const Shark& shark, const DiveContext& in) {
    return shark.position + shark.forward * (0.46f * in.kindOf(shark).length_m);
}

static float fromMouth(const Shark& shark, const Hand& hand, const DiveContext& in) {
    return glm::distance(mouthOf(shark, in), hand.graspCentre);
}

// Returns the hand that holds a fish, or else the one nearest to the shark's mouth; -1 if none is visible.
static int watchedHand(const Shark& shark, const DiveContext& in) {
    return leastCost(in.state.hands, kNever, [&](const Hand& hand) {
        const int held = hand.grasp.holds;
        const bool holds = held >= 0 && in.thingOf(in.state.fish[held]) == Thing::None;
        return hand.visible ? fromMouth(shark, hand, in) - (holds ? 10.0f : 0.0f) : kNever;
    });
}

// Returns how much nearer the shark's mouth may come while it threatens that hand; negative if it is too
// near. The shark keeps its distance from the hand and from the player's head.
static float threatSpare(const Shark& shark, int hand, const DiveContext& in) {
    return std::min(fromMouth(shark, in.state.hands[hand], in) - kThreatRoom_m,
                    glm::distance(mouthOf(shark, in), in.head()) - kSharkApart_m);
}

// Returns a fish that struggles in a hand, -1 if none does.
static int strugglingFish(const DiveContext& in) {
    int struggling = -1;
    for (const Hand& hand : in.state.hands) {
        const int held = hand.grasp.holds;
        if (held < 0 || in.thingOf(in.state.fish[held]) != Thing::None) continue;
        const FishHold& hold = in.state.fish[held].hold;
        if (!hold.counted && hold.time_s > 0.12f) struggling = held;
    }
    return struggling;
}

static void decideCircling(Shark& shark, const DiveContext& in, Events& events) {
    const SharkPlan& plan = in.dive.shark;
    const bool due =
        shark.nextVisit < plan.visits_s.size() && in.state.time_s() >= plan.visits_s[shark.nextVisit];
    if (due) ++shark.nextVisit;
    const bool tempted = shark.interest > kTempted && shark.state_s > 8;
    if (in.state.phase != Phase::Diving || !(due || tempted)) return;
    shark.set(State::Prowl);
    shark.threatRest_s = 0;
    shark.visit_s = plan.visitLength_s;
    shark.interest = 0;
    shark.bumpRest_s = std::max(shark.bumpRest_s, kNotice_s);
    const int id = static_cast<int>(in.state.fish.size());
    events.push_back({.kind = EventKind::SharkNear, .creature = id, .position = shark.position});
}

// Ends a threat or a strike.
static void goOn(Shark& shark) { shark.set(shark.visit_s > 0 ? State::Prowl : State::Leave); }

// Warns the player, and scatters the fish near its mouth.
static void threaten(Shark& shark, int hand, std::span<Fish> fish, const DiveContext& in, Random& random,
                     Events& events) {
    shark.set(State::Threaten);
    shark.watched = hand;
    shark.aimed_s = 0;
    const glm::vec3 mouth = mouthOf(shark, in);
    events.push_back({EventKind::SharkAims, static_cast<int>(fish.size()), hand, mouth});
    for (size_t i = 0; i < fish.size(); ++i)
        if (fish[i].state == Fish::State::Cruise && glm::distance(fish[i].position, mouth) < kScatter_m)
            startle(fish[i], static_cast<int>(i), mouth, in, random, events);
}

// Returns the hand that it begins to threaten; -1: none.
static int decideProwling(Shark& shark, const DiveContext& in, int struggling) {
    if (openRadius(shark.position, in) > kVisitRoom_m) shark.visit_s -= kDt; // else it waits for room
    shark.threatRest_s -= kDt;
    if (shark.visit_s <= 0) shark.set(State::Leave);
    const int h = shark.state == State::Prowl ? watchedHand(shark, in) : -1;
    if (h < 0) return -1;
    const Hand& hand = in.state.hands[h];
    const bool holds = struggling >= 0 && hand.grasp.holds == struggling;
    const bool near =
        fromMouth(shark, hand, in) < kThreatFrom_m && threatSpare(shark, h, in) > kThreatSpare_m;
    return near && (holds || shark.threatRest_s <= 0) ? h : -1;
}

static void decideThreatening(Shark& shark, const DiveContext& in, int struggling) {
    shark.visit_s -= kDt;
    const Hand& hand = in.state.hands[shark.watched];
    const glm::vec3 to = hand.graspCentre - shark.position;
    const bool aimed = glm::dot(shark.forward, normalizedOr(to, shark.forward)) > kAimed;
    shark.aimed_s = aimed ? shark.aimed_s + kDt : 0;
    const bool held = struggling >= 0 && hand.grasp.holds == struggling;
    if (held && shark.aimed_s >= kAim_s && fromMouth(shark, hand, in) < kStrikeFrom_m) {
        shark.prey = struggling;
        shark.set(State::Strike);
    } else if (!hand.visible || threatSpare(shark, shark.watched, in) < -0.3f || shark.state_s > kThreat_s) {
        shark.threatRest_s = kThreatRest_s;
        goOn(shark);
    }
}

static void decideStriking(Shark& shark, const DiveContext& in) {
    const Fish& prey = in.state.fish[shark.prey];
    if (prey.state == Fish::State::Held && !prey.hold.counted && shark.state_s <= kStrikeTime_s) return;
    shark.prey = -1;
    goOn(shark);
}

// Returns whether the shark is back on its circle, or as far out as the film's surfaces let it swim there.
static bool isFarOut(const Shark& shark, const DiveContext& in) {
    return placeOf(shark.position).radius > openRadius(shark.position, in) - kFarOut_m;
}

static void steal(Shark& shark, Fish& f, int id, Hands& hands, Score& score, Events& events) {
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

// Moves the caught fish along with the shark's mouth and turns it to lie across the jaws.
static void carryInMouth(const Shark& shark, glm::vec3 mouth, Fish& f) {
    const glm::vec3 was = f.position;
    const glm::vec3 at = mouth - 0.05f * kUp;
    f.position += (at - f.position) * 0.3f;
    f.velocity = (f.position - was) / kDt;
    f.forward = leftOf(shark.forward) * shark.direction;
    f.worldFromBody = blended(f.worldFromBody, bodyTurn(f.forward, 0), 0.15f);
    f.speed = 0;
    f.gait.set(Motion::Struggle);
    f.gait.advance(1.2f);
    f.shape.beats += 4 * kDt;
    f.shape.amplitude += (0.1f - f.shape.amplitude) * (5 * kDt);
}

// Frees the fish in the shark's mouth; the fish flees inwards, towards its school's band.
static void breakFree(Shark& shark, Fish& f) {
    f.state = Fish::State::Dart;
    f.flight.left_s = 1.0f;
    f.flight.rest_s = 2;
    f.uncatchable_s = kUncatchable_s;
    f.flight.heading = normalizedOr({-f.position.x, 0, -f.position.z}, f.forward);
    shark.mouth = -1;
}

void decide(Shark& shark, std::span<Fish> fish, const DiveContext& in, Random& random, Events& events) {
    shark.bumpRest_s = std::max(0.0f, shark.bumpRest_s - kDt);
    shark.state_s += kDt;
    shark.warned_s = shark.aims() ? shark.warned_s + kDt : 0;
    const int struggling = strugglingFish(in);
    shark.interest = struggling >= 0 ? shark.interest + kDt : std::max(0.0f, shark.interest - 0.03f * kDt);
    switch (shark.state) {
    case State::Circle:
        return decideCircling(shark, in, events);
    case State::Prowl:
        if (const int hand = decideProwling(shark, in, struggling); hand >= 0)
            threaten(shark, hand, fish, in, random, events);
        return;
    case State::Threaten:
        return decideThreatening(shark, in, struggling);
    case State::Strike:
        return decideStriking(shark, in);
    case State::Leave:
        if (isFarOut(shark, in) || shark.state_s > 15) shark.set(State::Circle);
    }
}

void turnAway(Shark& shark, bool struck, const DiveContext& in, Events& events) {
    const bool strikes = shark.state == State::Strike;
    if (strikes ? !struck : shark.state != State::Prowl && shark.state != State::Threaten) return;
    shark.prey = -1;
    shark.visit_s = 0;
    shark.set(State::Leave);
    events.push_back({EventKind::SharkTurns, static_cast<int>(in.state.fish.size()), -1, shark.position});
}

void bite(Shark& shark, Hands& hands, std::span<Fish> fish, Score& score, const DiveContext& in,
          Events& events) {
    const glm::vec3 mouth = mouthOf(shark, in);
    const bool strikes = shark.state == State::Strike && shark.warned_s >= kWarned_s;
    if (strikes && fish[shark.prey].hold.time_s >= kGrasped_s &&
        glm::distance(mouth, fish[shark.prey].position) < kJaws_m)
        steal(shark, fish[shark.prey], shark.prey, hands, score, events);
    if (shark.mouth >= 0) {
        Fish& f = fish[shark.mouth];
        carryInMouth(shark, mouth, f);
        if (isFarOut(shark, in) || shark.state == State::Circle) breakFree(shark, f);
    }
    if (shark.gait.motion != Motion::Bite || shark.state_s > 0.6f)
        shark.gait.set(shark.state == State::Strike ? Motion::Lunge : Motion::Cruise);
    shark.gait.advance(std::clamp(shark.speed / in.kindOf(shark).cruise_mps, 0.6f, 2.0f));
}

void bumpHands(Shark& shark, std::span<const physics::Contact> own, Hands& hands, std::span<Fish> fish,
               const DiveContext& in, Events& events) {
    // If a wall or the room around the eyes pushes the shark along a hand, it only brushes the hand: no bump.
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
        if (hands[h].grasp.holds >= 0) drop(hands[h], h, fish, in, events);
    }
}

// Swimming.

namespace {

constexpr float kNarrow_m = 1.5f;          // circle radius below which it passes the player too near
constexpr float kSharkRockShy_m = 0.8f;    // gap to the film's surfaces below which it turns away
constexpr float kHandShy_m = 0.8f;         // distance from its mouth to a hand below which it turns away
constexpr float kRoomAhead_m = 2.8f;       // the shark turns back if it has less room ahead...
constexpr float kWider_m = 0.5f;           // ...and this much more room the other way
constexpr float kSharkGiveRoom_mps = 3.0f; // greatest speed at which an approaching wall moves it

// Direction, speed and turning rate that the shark wants.
struct Course {
    glm::vec3 way{0};
    float speed_mps = 0;
    float turn_radps = 0;
};

// Returns the course along the circle of the shark's state. A visit is a series of approaches: close past
// the player, far out, and in again.
Course circle(const Shark& shark, const DiveContext& in) {
    const Species& kind = in.kindOf(shark);
    const SharkPlan& plan = in.dive.shark;
    const auto [radius, outward] = placeOf(shark.position);
    const bool visits = shark.state == State::Prowl;
    const bool wide = shark.threatRest_s > 0 && shark.threatRest_s < 0.6f * kThreatRest_s;
    const float open = std::min(openRadius(shark.position, in), futureOpenRadius(shark.position, in));
    const float goal = std::min(visits ? (wide ? kWide_m : plan.prowlRadius_m) : plan.radius_m,
                                std::max(open, kSharkApart_m + 0.2f));
    const float height = visits ? 0.5f * plan.height_m : plan.height_m;
    Course course;
    course.way = glm::cross(kUp, outward) * shark.direction +
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

Course courseOf(const Shark& shark, const DiveContext& in) {
    const Species& kind = in.kindOf(shark);
    if (shark.state == State::Threaten) {
        const float spare = threatSpare(shark, shark.watched, in);
        return {in.state.hands[shark.watched].graspCentre - shark.position,
                0.4f * kind.cruise_mps * std::clamp(2 * spare, 0.0f, 1.0f), 1.8f};
    }
    if (shark.state == State::Strike) { // it turns, dashes, and brakes before it bites: it does not ram
        const glm::vec3 prey = in.state.fish[shark.prey].position, way = prey - shark.position;
        const float distance = glm::length(prey - mouthOf(shark, in));
        const float aimed = std::max(0.0f, glm::dot(shark.forward, normalizedOr(way, shark.forward)));
        return {way,
                kind.dart_mps * std::clamp(aimed * aimed, 0.25f, 1.0f) *
                    std::clamp(0.3f + distance, 0.4f, 1.0f),
                4};
    }
    Course course = circle(shark, in);
    if (shark.state == State::Leave) {
        const glm::vec3 outward = placeOf(shark.position).outward;
        course.way += outward * 1.2f;
        course.speed_mps =
            glm::dot(shark.forward, outward) > 0.2f ? 1.7f * kind.cruise_mps : 0.6f * kind.cruise_mps;
        course.turn_radps *= 2.6f;
    }
    return course;
}

// Steers it around the player's head and hands.
void avoidPlayer(const Shark& shark, const DiveContext& in, Course& course) {
    if (shark.aims()) return;
    const glm::vec3 nose = mouthOf(shark, in);
    const auto avoid = [&](glm::vec3 from, float shy_m, float least_mps) {
        const glm::vec3 apart = nose - from;
        const float distance = glm::length(apart);
        if (distance >= shy_m) return;
        course.way += apart / std::max(distance, 0.05f) * (2.5f * (shy_m - distance));
        if (glm::dot(shark.forward, apart) < 0)
            course.speed_mps = std::clamp(distance - 0.5f * shy_m, least_mps, course.speed_mps);
    };
    avoid(in.head(), kSharkApart_m + 0.15f, 0.5f * in.kindOf(shark).cruise_mps);
    if (!in.film.known()) return;
    for (const Hand& hand : in.state.hands)
        if (hand.visible) avoid(hand.graspCentre, kHandShy_m, 0);
}

// Returns the future open radius at a bearing, at most kSharkApart_m if a hand there leaves no room to pass.
float roomAt(glm::vec3 outward, const DiveContext& in) {
    const float open = futureOpenRadius(outward, in);
    for (const Hand& hand : in.state.hands) {
        const Place at = placeOf(hand.graspCentre);
        const bool beside = hand.visible && glm::dot(at.outward, outward) > 0.7f;
        if (beside && open < at.radius + kHandShy_m) return std::min(open, kSharkApart_m);
    }
    return open;
}

// Returns the greatest future room at three bearings to one side; narrow places on the way there reduce it.
float roomTowards(const Shark& shark, const DiveContext& in, float direction) {
    float most = 0, passed = in.dive.shark.radius_m;
    glm::vec3 outward = placeOf(shark.position).outward;
    for (int step = 1; step <= 3; ++step) {
        outward = normalizedOr(outward + 0.65f * direction * glm::cross(kUp, outward), outward); // 33 degrees
        const float room = roomAt(outward, in);
        passed = std::min(passed, room);
        most = std::max(most, room - std::max(0.0f, kNarrow_m - passed));
    }
    return most;
}

// Reverses the shark if its circle leads to a wall and there is more room the other way.
void turnBack(Shark& shark, const DiveContext& in) {
    if (!in.film.known() || shark.aims()) return;
    const float ahead = roomTowards(shark, in, shark.direction);
    if (ahead < kRoomAhead_m && roomTowards(shark, in, -shark.direction) > ahead + kWider_m)
        shark.direction = -shark.direction;
}

void avoidRock(const Shark& shark, const Species& kind, const FilmMoment& film, Course& course) {
    if (!film.known()) return;
    const glm::vec3 soon = shark.position + 0.5f * kind.length_m * shark.forward;
    const float gap = film.gap_m(soon) - kind.bodyRadius_m;
    course.turn_radps *= 1 + 0.5f * film.keepOff(course.way, soon, gap, kSharkRockShy_m, 1);
}

// Moves the shark so that its body's axis leaves the room around the player's eyes.
void keepFromEyes(Shark& shark, float room_m, const DiveContext& in) {
    const float reach = 0.46f * in.kindOf(shark).length_m;
    const glm::vec3 fromHead = shark.position - in.head();
    const float t = std::clamp(-glm::dot(fromHead, shark.forward), -reach, reach);
    const glm::vec3 nearest = fromHead + shark.forward * t;
    const float missing = room_m - glm::length(nearest);
    if (missing > 0)
        shark.position += normalizedOr(nearest, placeOf(shark.position).outward) *
                          std::min(missing, kSharkGiveRoom_mps * kDt);
}

// Bends body and tail. A threatening shark arches its back, raises its snout, lowers its pectoral fins and
// swings slowly and wide: Johnson & Nelson 1973, "Agonistic display in the gray reef shark".
void bendAndBeat(Shark& shark, const Species& kind, glm::vec3 desiredSpin) {
    const bool threatens = shark.state == State::Threaten;
    BodyShape& shape = shark.shape;
    beatTail(shark, kind, threatens ? 0.5f : 0.0f);
    const float amplitude = threatens ? 1.5f * kFullBeat : tailAmplitude(shark.speed / kind.cruise_mps);
    shape.amplitude = eased(shape.amplitude, amplitude, 4);
    shape.bendLeft =
        eased(shape.bendLeft, bendFor(shark, glm::dot(desiredSpin, kUp), kind.length_m, kMaxBendLeft), 3);
    const float pitch = bendFor(shark, -glm::dot(desiredSpin, leftOf(shark.forward)), kind.length_m, 0.2f);
    shape.bendUp = eased(shape.bendUp, threatens ? 0.4f : pitch, 5);
    shape.finsDown = eased(shape.finsDown, threatens ? BodyShape::kThreatens : 0.0f, 5);
}

} // namespace

void swimShark(Shark& shark, const DiveContext& in) {
    const Species& kind = in.kindOf(shark);
    const FilmMoment film = in.film.as(FilmSpace::Room::Shark);
    turnBack(shark, in);
    Course course = courseOf(shark, in);
    avoidRock(shark, kind, film, course);
    avoidPlayer(shark, in, course);

    const glm::vec3 goal = levelled(normalizedOr(course.way, shark.forward), 0.35f);
    const bool strikes = shark.state == State::Strike;
    const float turn = course.turn_radps;
    const glm::vec3 spin =
        turnSmoothly(shark, goal, strikes ? 8.0f : 2.5f * turn, turn, strikes ? 40.0f : 8.0f * turn);
    shark.forward = levelled(shark.forward, 0.4f);
    bankIntoTurn(shark, 0.3f, 0.6f, 3);
    shark.speed =
        towards(shark.speed, course.speed_mps, (course.speed_mps > shark.speed ? 5.0f : 3.0f) * kDt);

    const glm::vec3 from = shark.position;
    shark.position += shark.forward * shark.speed * kDt;
    if (!strikes) keepFromEyes(shark, kSharkApart_m, in);
    const float spare_m = glm::distance(shark.position, in.head()) - kSharkEyeRoom_m;
    shark.position =
        film.pulledIn(shark.position, capsuleOf(shark, kind), std::min(spare_m, kSharkGiveRoom_mps * kDt));
    keepFromEyes(shark, kSharkEyeRoom_m, in);
    shark.position.y = std::max(shark.position.y, in.dive.floor_m + kind.bodyRadius_m + 0.05f);
    shark.velocity = (shark.position - from) / kDt;
    shark.worldFromBody = bodyTurn(shark.forward, shark.bank);
    bendAndBeat(shark, kind, spin);
}

void startInFreeSpace(Shark& shark, const DiveContext& in) {
    if (!shark.present) return;
    // Takes the first of sixteen bearings that has room for the whole radius, or else the one with most room.
    constexpr int kBearings = 16;
    const SharkPlan& plan = in.dive.shark;
    const glm::quat turn = math::rotationAbout(kUp, 2 * std::numbers::pi_v<float> / kBearings);
    float most = 0;
    glm::vec3 outward = placeOf(shark.position).outward, best = outward;
    for (int i = 0; i < kBearings && most < plan.radius_m; ++i, outward = turn * outward)
        if (const float open = openRadius(outward, in); open > most) most = open, best = outward;
    startCircling(shark, best * most + kUp * plan.height_m, best, shark.direction, shark.speed);
}

} // namespace shoal::game
