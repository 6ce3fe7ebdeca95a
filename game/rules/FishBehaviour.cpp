#include "game/rules/FishBehaviour.h"

#include "game/rules/Grasping.h"
#include "game/rules/Intent.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

constexpr float kOrientation = 3;   // outer radius of the zone of orientation, in spacings
constexpr float kAttraction = 1.6f; // inner radius of the zone of attraction, in spacings
constexpr float kSight_m = 1.1f;    // strangers farther away are ignored
constexpr float kTouch_m = 0.04f;   // gap below which bodies push each other
constexpr float kForesee_s = 0.5f;  // look-ahead for fish that will be too near

// Adds one fish's avoidance of another to out. away: unit; gap: between the bodies, metres; urgency: 0 to 1.
static void giveWay(const Fish& f, const Species& kind, glm::vec3 away, float gap, float urgency,
                    Neighbours& out) {
    const float pace = std::max(kind.cruise_mps, f.speed);
    out.giveWay += away * (1.8f * urgency * pace);
    if (gap < kTouch_m)
        out.push += away * (8.0f * (pace / kind.cruise_mps) * std::min(1 - gap / kTouch_m, 2.0f) * kDt);
}

static void accompany(const Fish& other, glm::vec3 towards, float distance, float spacing, Neighbours& out) {
    if (distance < kOrientation * spacing) {
        out.headings += other.forward;
        ++out.aligned;
    }
    if (distance > kAttraction * spacing) {
        out.towards += towards;
        ++out.attracted;
    }
}

static void gatherPair(const Fish& a, const Species& kindA, Neighbours& ofA, const Fish& b,
                       const Species& kindB, Neighbours& ofB) {
    const bool companions = a.route.leader == b.route.leader;
    const glm::vec3 apart = a.position - b.position;
    const float squared = glm::dot(apart, apart);
    if ((!companions && squared > kSight_m * kSight_m) || !b.swims()) return;
    const float spacing = kindA.spacing * kindA.length_m;
    // Fish whose centres are, or soon will be, nearer than this give way.
    const float room = companions ? spacing : 0.45f * (kindA.length_m + kindB.length_m) + 0.08f;
    const float distance = std::sqrt(squared);
    const glm::vec3 soon = apart + kForesee_s * (a.velocity - b.velocity);
    const float nearest = std::min(distance, glm::length(soon));
    if (nearest < room) {
        const glm::vec3 away = distance > 1e-4f ? apart / distance : glm::vec3(0, -1, 0);
        const float gap =
            distance < room ? physics::separation(capsuleOf(a, kindA), capsuleOf(b, kindB)) : room;
        giveWay(a, kindA, away, gap, 1 - nearest / room, ofA);
        giveWay(b, kindB, -away, gap, 1 - nearest / room, ofB);
    }
    if (!companions) return;
    accompany(b, -apart, distance, spacing, ofA);
    accompany(a, apart, distance, spacing, ofB);
}

void gatherNeighbours(std::span<const Fish> fish, const SpeciesTable& species, std::span<Neighbours> out) {
    std::fill(out.begin(), out.end(), Neighbours{});
    for (size_t i = 0; i < fish.size(); ++i) {
        if (!fish[i].swims()) continue;
        for (size_t j = 0; j < i; ++j)
            gatherPair(fish[i], species[fish[i].species], out[i], fish[j], species[fish[j].species], out[j]);
    }
}

void startle(Fish& f, int id, glm::vec3 from, const DiveContext& in, Random& random, Events& events) {
    if (!f.swims()) return;
    // The flight leads away from the danger, more level than up or down, and not through the player.
    const glm::vec3 away = normalizedOr(f.position - from, f.forward), fromHead = f.position - in.head();
    const glm::vec3 outward = normalizedOr({fromHead.x, 0, fromHead.z}, {0, 0, -1});
    f.flight.heading =
        normalizedOr(glm::vec3(away.x, 0.4f * away.y, away.z) + outward * 0.5f + f.forward * 0.3f, f.forward);
    f.flight.left_s = 0.8f + 0.5f * random.unit();
    f.flight.touchedGently_s = 0;
    if (f.flight.rest_s > 0) return;
    f.state = Fish::State::Dart;
    f.flight.rest_s = 1.5f;
    events.push_back({.kind = EventKind::Startle, .creature = id, .position = f.position});
}

constexpr float kFrightens_mps = 1.2f; // approach speed from which a hand frightens fish

// Returns the speed at which the hand approaches a fish that notices it; 0 if the fish does not. margin_m is
// added to the distance from which the fish notices the hand.
static float noticed_mps(const Fish& f, const Hand& hand, float margin_m, const DiveContext& in) {
    if (f.state != Fish::State::Cruise || f.flight.rest_s > 0 || feeds(f, in.state.hands)) return 0;
    const glm::vec3 apart = f.position - hand.graspCentre;
    const float distance = glm::length(apart);
    if (distance > 0.8f || distance < 1e-4f) return 0;
    // With shyness 1, a hand at 1.2 m/s is noticed from 0.23 m, and at 3 m/s from 0.5 m.
    const float closing = glm::dot(hand.ownVelocity - f.velocity, apart / distance);
    const float from_m =
        in.kindOf(f).shyness * (0.05f + 0.15f * std::max(closing, kFrightens_mps)) + margin_m;
    return distance > from_m ? 0 : closing;
}

float hasteOf(const Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    constexpr float kShownFrom = 2.0f / 3, kAhead_m = 0.2f;
    float most = 0;
    for (const Fish& f : fish) most = std::max(most, noticed_mps(f, hand, kAhead_m, in));
    return std::clamp((most / kFrightens_mps - kShownFrom) / (1 - kShownFrom), 0.0f, 1.0f);
}

void frightenByHands(std::span<Fish> fish, const DiveContext& in, Random& random, Events& events) {
    for (const Hand& hand : in.state.hands) {
        if (!hand.solid) continue;
        for (size_t i = 0; i < fish.size(); ++i) {
            Fish& f = fish[i];
            const int id = static_cast<int>(i);
            if (helpedTo(hand, id) || noticed_mps(f, hand, 0, in) < kFrightens_mps) continue;
            startle(f, id, hand.graspCentre, in, random, events);
        }
    }
}

// Visits.

constexpr float kStill_mps = 0.2f;   // a hand comes to rest below this speed...
constexpr float kFast_mps = 0.6f;    // ...and rests until it exceeds this one
constexpr float kRest_s = 1;         // time a hand must rest before the first visitor comes
constexpr float kNext_s = 2;         // time between two visitors
constexpr int kVisitors = 2;         // most visitors of a hand at a time
constexpr int kGuests = 5;           // most visitors of a hand with a cracked mussel...
constexpr float kSmell_m = 3;        // ...the distance from which they come...
constexpr float kNextGuest_s = 0.2f; // ...and the time between two of them
constexpr float kInView = 0.82f;     // cosine of the angle from the middle of the view: 35 degrees
constexpr float kNearest_m = 0.25f, kFarthest_m = 2.2f; // distance of a possible visitor from the hand
constexpr float kComes_s = 7;                           // longest time on the way to the hand
constexpr float kThere_m = 0.12f;                       // distance to visitedPlace() at which it has arrived
constexpr float kBefore_m = 0.06f;                      // distance from the grasp centre to visitedPlace()

static bool isStill(const Hand& hand, const Viewpoint& view) {
    const bool open = hand.visible && hand.solid && hand.grip < kGripOpens && hand.stung_s == 0;
    const glm::vec3 way = normalizedOr(hand.graspCentre - view.headWorld, view.ahead());
    return open && glm::dot(way, view.ahead()) > kInView && glm::length(hand.calmVelocity) < kStill_mps;
}

static void noteRest(Hand& hand, const Viewpoint& view) {
    if (isStill(hand, view))
        hand.rested_s += kDt;
    else if (!hand.visible || hand.grip > kGripCloses || glm::length(hand.calmVelocity) > kFast_mps)
        hand.rested_s = 0;
    hand.nextVisit_s = std::max(0.0f, hand.nextVisit_s - kDt);
}

static void advanceVisit(Visit& visit, const Fish& f, const Hands& hands, Random& random) {
    visit.rest_s = std::max(0.0f, visit.rest_s - kDt);
    if (visit.hand < 0) return;
    const Hand& hand = hands[visit.hand];
    const bool there = glm::distance(f.position, visitedPlace(hand)) < kThere_m;
    visit.left_s -= there ? kDt : kDt * (visit.linger_s / kComes_s);
    const bool stays = hand.baitLeft_s > 0 || (hand.rested_s > 0 && visit.left_s > 0);
    if (f.state == Fish::State::Cruise && stays) return;
    visit.hand = -1;
    visit.rest_s = random.between(6, 14);
}

// Returns the fish with the least distance divided by curiosity; -1: none may come. To a hand without food,
// fish come only from ahead of the player.
static int nextVisitor(const Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    return leastCost(fish, kNever, [&](const Fish& f) {
        const float curiosity = in.kindOf(f).curiosity;
        if (f.state != Fish::State::Cruise || f.visit.hand >= 0 || curiosity <= 0) return kNever;
        const float distance = glm::distance(f.position, hand.graspCentre);
        if (distance > (hand.baitLeft_s > 0 ? kSmell_m : kFarthest_m)) return kNever;
        if (hand.baitLeft_s > 0) return in.hides(f.position) ? kNever : distance / curiosity;
        if (f.visit.rest_s > 0 || f.uncatchable_s > 0 || f.flight.rest_s > 0) return kNever;
        if (distance < kNearest_m) return kNever;
        if (glm::dot(f.position - in.head(), in.state.view.ahead()) < 0.3f) return kNever;
        return distance / curiosity;
    });
}

glm::vec3 visitedPlace(const Hand& hand) { return hand.graspCentre + hand.outOfPalm() * kBefore_m; }

void chooseVisitors(Hands& hands, std::span<Fish> fish, const DiveContext& in, Random& random) {
    for (Hand& hand : hands) noteRest(hand, in.state.view);
    std::array<int, 2> visitors{};
    for (Fish& f : fish) {
        advanceVisit(f.visit, f, hands, random);
        if (f.visit.hand >= 0) ++visitors[f.visit.hand];
    }
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        const bool baited = hand.baitLeft_s > 0;
        if (!baited && hand.rested_s < kRest_s) continue;
        if (hand.nextVisit_s > 0 || visitors[h] >= (baited ? kGuests : kVisitors)) continue;
        hand.nextVisit_s = baited ? kNextGuest_s : kNext_s;
        const int id = nextVisitor(hand, fish, in);
        if (id < 0) continue;
        Visit& visit = fish[id].visit;
        visit.hand = h;
        visit.left_s = visit.linger_s = random.between(2, 4);
    }
}

// Swimming.

namespace {

constexpr float kInner_m = 0.45f;     // least distance from the vertical axis through the player
constexpr float kEyeRoom_m = 0.35f;   // least distance of any part of a fish from the eyes
constexpr float kEyeShy_m = 0.45f;    // margin beyond kEyeRoom_m in which it turns away
constexpr float kOuterSlack_m = 1.2f; // how far a frightened fish may leave its school's ring
constexpr float kCeiling_m = 1.3f;
constexpr float kRockShy_m = 0.4f;     // gap to the film's surfaces below which it turns away
constexpr float kRockForesee_s = 0.5f; // how far ahead it looks for that gap
constexpr float kGiveRoom_mps = 2.0f;  // greatest speed at which an approaching surface pushes it
constexpr float kSharkShy_m = 0.95f;
constexpr float kHungry = 4.5f;       // speed on the way to food, in cruising speeds
constexpr float kVisitSlow_m = 0.25f; // distance from a visited place below which it slows down
constexpr float kSteepest = 0.42f;    // sine of the pitch while cruising...
constexpr float kSteepestDart = 0.6f; // ...and in flight

// A fast start: the body snaps into a C, away from the threat, and only then drives off. Domenici & Blake
// 1997, "The kinematics and performance of fish fast-start swimming": turns of 1 to 2 rad in 20 to 60 ms by
// fish of this size, then 40 to 100 m/s^2; both slowed here so that an eye can follow.
constexpr float kSnap_s = 0.07f;

bool darts(const Fish& f) { return f.state == Fish::State::Dart; }
bool snaps(const Fish& f) { return f.flight.spent_s > 0 && f.flight.spent_s <= kSnap_s; }

// Desired direction of a fish, as a sum of steering velocities, and its desired speed.
struct Desire {
    glm::vec3 way{0}; // m/s
    float speed = 0;  // m/s
    bool afraid = false;
};

Desire flee(const Fish& f, const Species& kind, const Place& place, const School& school) {
    Desire desire{.afraid = true};
    desire.way = f.flight.heading * kind.dart_mps + place.outward * (place.radius < 0.6f ? 0.8f : 0.0f);
    desire.speed = kind.dart_mps * std::min(1.0f, 0.35f + f.flight.left_s);
    const float outer = school.radiusHigh_m + 0.6f * kOuterSlack_m;
    if (place.radius > outer) desire.way -= place.outward * kind.dart_mps * 1.2f;
    return desire;
}

// Follows its circle, returns to it, closes up to its companions and swims parallel to them.
Desire cruise(const Fish& f, const Species& kind, const Place& place, const Neighbours& around) {
    const Route& route = f.route;
    Desire desire;
    const float own = kind.company == Company::Alone ? 0.3f : 0.25f;
    desire.way = glm::cross(kUp, place.outward) * route.direction +
                 place.outward * std::clamp(1.5f * (route.radius - place.radius), -1.2f, 1.2f) +
                 kUp * std::clamp(1.5f * (route.height - f.position.y), -0.7f, 0.7f) + own * route.wander;
    desire.way *= route.cruise_mps;
    desire.speed = route.cruise_mps * route.speedFactor;
    if (around.aligned > 0) desire.way += normalizedOr(around.headings, f.forward) * route.cruise_mps;
    if (around.attracted > 0) {
        const glm::vec3 towards = around.towards / static_cast<float>(around.attracted);
        const float reach = 3 * kind.spacing * kind.length_m;
        const glm::vec3 pull = limited(towards / reach, 1);
        desire.way += pull * (1.2f * route.cruise_mps);
        // A fish behind its companions hurries, one ahead of them waits.
        desire.speed *= 1 + 0.5f * glm::dot(pull, f.forward);
    }
    return desire;
}

// Swims to the place in front of the palm, slowly at the end, and hovers there facing the hand.
Desire visit(const Fish& f, const Hand& hand) {
    const glm::vec3 apart = visitedPlace(hand) - f.position;
    const float distance = glm::length(apart);
    const float share = std::min(1.0f, distance / kVisitSlow_m);
    const glm::vec3 looks = normalizedOr(hand.graspCentre - f.position, f.forward);
    return {normalizedOr(apart, looks) * (f.route.cruise_mps * share) + looks * (0.2f * f.route.cruise_mps),
            (hand.baitLeft_s > 0 ? kHungry : 1.3f) * f.route.cruise_mps * share};
}

// Steers a fish around the player's head.
void avoidHead(const Fish& f, float length_m, glm::vec3 head, Desire& desire) {
    const glm::vec3 apart = f.position - head;
    const float distance = glm::length(apart);
    const float room = distance - kEyeRoom_m - 0.5f * length_m;
    const float shy_m = f.visit.hand >= 0 ? 0.3f * kEyeShy_m : kEyeShy_m;
    if (room < shy_m && distance > 1e-4f)
        desire.way += apart / distance * (2.5f * (1 - room / shy_m) * std::max(f.route.cruise_mps, f.speed));
}

// Steers a fish around hands, unless it flees or visits the hand.
void avoidHands(const Fish& f, const Hands& hands, Desire& desire) {
    for (int h = 0; h < 2; ++h) {
        const Hand& hand = hands[h];
        if (!hand.visible || darts(f) || f.visit.hand == h) continue;
        const glm::vec3 apart = f.position - hand.graspCentre;
        const float distance = glm::length(apart);
        if (distance < 0.25f && distance > 1e-4f)
            desire.way += apart / distance * (0.7f * f.route.cruise_mps * (1 - distance / 0.25f));
    }
}

void avoidShark(const Fish& f, const DiveContext& in, Desire& desire) {
    const Shark& shark = in.state.shark;
    if (!shark.present) return;
    const Species& kind = in.kindOf(f);
    const float half = in.kindOf(shark).bodyHalf_m;
    const float t = std::clamp(glm::dot(f.position - shark.position, shark.forward), -half, half);
    const glm::vec3 apart = f.position - (shark.position + shark.forward * t);
    const float distance = glm::length(apart);
    if (distance >= kSharkShy_m || distance <= 1e-4f) return;
    const float fear = 1 - distance / kSharkShy_m;
    desire.way += apart / distance * (2.5f * fear * kind.dart_mps);
    const float hurried = f.route.cruise_mps + 2.2f * fear * kind.dart_mps;
    desire.speed = std::max(desire.speed, std::min(kind.dart_mps, hurried));
    desire.afraid = true;
}

// Levels a fish out before it reaches the floor or the ceiling.
void avoidFloor(const Fish& f, float floor_m, Desire& desire) {
    const float firmly = 2 + 5 * f.speed;
    const float low = floor_m + 0.25f, high = kCeiling_m - 0.25f;
    if (f.position.y < low) desire.way.y += firmly * (low - f.position.y);
    if (f.position.y > high) desire.way.y -= firmly * (f.position.y - high);
}

void avoidRock(const Fish& f, const Species& kind, const FilmMoment& film, Desire& desire) {
    if (!film.known()) return;
    const glm::vec3 soon = f.position + kRockForesee_s * f.velocity;
    const float gap = film.gap_m(soon) - kind.bodyHalf_m - kind.bodyRadius_m;
    film.keepOff(desire.way, soon, gap, kRockShy_m, std::max(f.route.cruise_mps, f.speed));
}

Desire desireOf(const Fish& f, const Neighbours& around, const DiveContext& in) {
    const Species& kind = in.kindOf(f);
    const Place place = placeOf(f.position);
    const bool visits = f.visit.hand >= 0 && !darts(f);
    Desire desire = darts(f) ? flee(f, kind, place, in.dive.schools[f.school])
                    : visits ? visit(f, in.state.hands[f.visit.hand])
                             : cruise(f, kind, place, around);
    avoidHead(f, kind.length_m, in.head(), desire);
    avoidHands(f, in.state.hands, desire);
    avoidShark(f, in, desire);
    desire.way += around.giveWay * (desire.afraid ? 3.5f : 1.0f);
    if (!desire.afraid) // it brakes for fish ahead
        desire.speed = std::max(visits ? 0.0f : 0.3f * f.route.cruise_mps,
                                desire.speed + std::min(0.0f, glm::dot(around.giveWay, f.forward)));
    avoidFloor(f, in.dive.floor_m, desire);
    avoidRock(f, kind, in.film, desire);
    return desire;
}

// Turns the heading towards the goal; returns the desired spin, rad/s.
glm::vec3 turn(Fish& f, int id, const Species& kind, const Desire& desire, glm::vec3 goal) {
    const bool darting = darts(f), snapping = snaps(f), afraid = desire.afraid;
    const float rate = snapping ? 26.0f : darting ? 9.0f : afraid ? 1.8f * kind.turn_radps : kind.turn_radps;
    const float eager = snapping ? 24.0f : darting ? 14.0f : afraid ? 6.0f : 3.0f;
    const float acceleration = snapping ? 1200 : darting ? 250 : 9 * rate;
    const glm::vec3 spin = turnSmoothly(f, goal, eager, rate, acceleration);
    f.forward = levelled(f.forward, kSteepestDart);
    if (f.flight.side == 0 && f.flight.spent_s > 0)
        f.flight.side = glm::dot(spin, kUp) < 0 || (glm::dot(spin, kUp) == 0 && id % 2) ? -1.0f : 1.0f;
    bankIntoTurn(f, 0.35f, 0.7f, 5);
    return spin;
}

// Switches between bursts and glides: Weihs 1974, "Energetic advantages of burst swimming of fish".
void chooseGliding(Fish& f, const Species& kind, const Desire& desire) {
    if (desire.afraid || !kind.coasts || f.speed < 0.75f * desire.speed)
        f.route.gliding = false;
    else if (f.speed > 1.2f * desire.speed)
        f.route.gliding = true;
}

void accelerate(Fish& f, const Species& kind, Desire desire, glm::vec3 goal) {
    // It swims slowly while it turns sharply.
    if (!desire.afraid) desire.speed *= 0.6f + 0.4f * std::max(0.0f, glm::dot(f.forward, goal));
    if (kind.coasts && !desire.afraid) desire.speed *= f.route.gliding ? 0.0f : 1.35f;
    const float drag = f.route.gliding ? 0.9f * f.speed : std::max(1.2f, 0.8f * f.speed);
    const float drive = darts(f) ? 22.0f : desire.afraid ? 9.0f : 2.5f * f.route.cruise_mps;
    f.speed = towards(f.speed, desire.speed, (desire.speed > f.speed ? drive : drag) * kDt);
}

void bendAndBeat(Fish& f, const Species& kind, glm::vec3 desiredSpin) {
    BodyShape& shape = f.shape;
    beatTail(f, kind);
    const float amplitude = f.route.gliding ? 0.0f : tailAmplitude(f.speed / kind.cruise_mps);
    shape.amplitude = eased(shape.amplitude, amplitude, 8);
    shape.bendUp =
        eased(shape.bendUp, bendFor(f, -glm::dot(desiredSpin, leftOf(f.forward)), kind.length_m, 0.35f), 6);
    shape.finsDown = eased(shape.finsDown, 0, 6);

    // In a fast start the body bends into a C, then back for the tail's stroke; else it bends along its path.
    constexpr float kC_s = 0.07f, kStroke_s = 0.17f, kC = 1.9f, kStroke = -0.7f;
    if (f.flight.spent_s > 0 && f.flight.spent_s < kStroke_s) {
        const float goal = f.flight.spent_s < kC_s ? kC : kStroke;
        shape.bendLeft = towards(shape.bendLeft, goal * f.flight.side, 34 * kDt);
    } else {
        const float goal = bendFor(f, glm::dot(desiredSpin, kUp), kind.length_m, kMaxBendLeft);
        shape.bendLeft = eased(shape.bendLeft, goal, darts(f) ? 14.0f : 5.0f);
    }
}

void keepInBounds(Fish& f, const DiveContext& in) {
    const Species& kind = in.kindOf(f);
    const float outer = in.dive.schools[f.school].radiusHigh_m + kOuterSlack_m;
    const auto [radius, outward] = placeOf(f.position);
    const float kept = std::clamp(radius, kInner_m, outer);
    // It moves back at no more than 1 m/s, so that nobody sees it jump.
    if (kept != radius) f.position += outward * std::clamp(kept - radius, -0.008f, 0.008f);
    const glm::vec3 fromHead = f.position - in.head();
    const float room = kEyeRoom_m + 0.5f * kind.length_m - glm::length(fromHead);
    if (room > 0) f.position += normalizedOr(fromHead, outward) * std::min(room, 0.008f);
    const float low = in.dive.floor_m + kind.bodyRadius_m + 0.04f;
    f.position.y = std::clamp(f.position.y, low, kCeiling_m);
}

// Moves a fish out of the film's surfaces, but not into the room around the eyes.
void keepInFreeSpace(Fish& f, const DiveContext& in, float most_m) {
    const Species& kind = in.kindOf(f);
    const float spare_m = glm::distance(f.position, in.head()) - kEyeRoom_m - 0.5f * kind.length_m;
    f.position = in.film.pulledIn(f.position, capsuleOf(f, kind), std::min(spare_m, most_m));
}

void move(Fish& f, const DiveContext& in) {
    f.push *= 1 - 2.5f * kDt; // water stops a pushed fish within a second
    f.push = limited(f.push, kMaxSpeed_mps);
    const glm::vec3 goal = limited(f.forward * f.speed + f.push + f.separation, kMaxSpeed_mps);
    const glm::vec3 from = f.position;
    f.position += goal * kDt;
    keepInBounds(f, in);
    keepInFreeSpace(f, in, kGiveRoom_mps * kDt);
    f.velocity = limited((f.position - from) / kDt, kMaxSpeed_mps);
    f.worldFromBody = bodyTurn(f.forward, f.bank);
}

void chooseGait(Fish& f, const Species& kind) {
    const bool hurried = darts(f) || f.speed > 2.2f * f.route.cruise_mps;
    f.gait.set(hurried ? Motion::Dart : Motion::Swim);
    // Fins row while the body hovers or brakes, and rest while it glides.
    const float pace = f.speed / kind.cruise_mps;
    f.gait.advance(f.route.gliding ? 0.5f : pace < 0.6f ? 1.4f : 1.0f);
}

void advanceFlight(Fish& f) {
    if (darts(f) && (f.flight.left_s -= kDt) <= 0) f.state = Fish::State::Cruise;
    f.flight.spent_s = darts(f) ? f.flight.spent_s + kDt : 0;
    if (f.flight.spent_s == 0) f.flight.side = 0;
}

// Renews a fish's wandering and route when their time is up. Companions take their leader's route.
void chooseRoute(Fish& f, int id, std::span<const Fish> fish, const DiveContext& in, Random& random) {
    Route& route = f.route;
    if (--route.wanderTicks <= 0) {
        route.wanderGoal = {random.between(-1, 1), random.between(-0.6f, 0.6f), random.between(-1, 1)};
        route.wanderTicks = 60 + static_cast<int>(random.below(180));
        // A solitary fish at times stops to look around.
        const bool lingers = in.kindOf(f).company == Company::Alone && random.unit() < 0.15f;
        route.speedFactor = lingers ? 0.2f : 1.0f;
    }
    route.wander += (route.wanderGoal - route.wander) * (1.2f * kDt);
    if (route.leader != id) return route.follow(fish[route.leader].route);
    if (--route.changeTicks > 0) return;
    const School& school = in.dive.schools[f.school];
    route.radius = random.between(school.radiusLow_m, school.radiusHigh_m);
    route.height = random.between(school.heightLow_m, school.heightHigh_m);
    if (random.unit() < 0.25f) route.direction = -route.direction;
    route.changeTicks = 600 + static_cast<int>(random.below(1200));
}

void swim(Fish& f, int id, const Neighbours& around, const DiveContext& in) {
    const Species& kind = in.kindOf(f);
    f.push += around.push;
    const Desire desire = desireOf(f, around, in);
    const glm::vec3 goal =
        levelled(normalizedOr(desire.way, f.forward), darts(f) ? kSteepestDart : kSteepest);
    const glm::vec3 spin = turn(f, id, kind, desire, goal);
    chooseGliding(f, kind, desire);
    if (!snaps(f)) accelerate(f, kind, desire, goal);
    bendAndBeat(f, kind, spin);
    move(f, in);
    chooseGait(f, kind);
}

} // namespace

void startInFreeSpace(std::span<Fish> fish, const DiveContext& in) {
    // Each move changes the directions that the body covers, so it is repeated; four rounds converge.
    for (int round = 0; round < 4; ++round)
        for (Fish& f : fish) keepInFreeSpace(f, in, FilmSpace::kFar_m);
}

void swimFish(std::span<Fish> fish, const DiveContext& in, std::span<Neighbours> neighbours, Random& random) {
    gatherNeighbours(fish, in.species, neighbours);
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        const int id = static_cast<int>(i);
        f.uncatchable_s = std::max(0.0f, f.uncatchable_s - kDt);
        f.flight.rest_s = std::max(0.0f, f.flight.rest_s - kDt);
        if (f.state == Fish::State::Held && in.thingOf(f) == Thing::None)
            struggle(f, in.state.hands[f.heldBy], random);
        if (!f.swims()) continue;
        advanceFlight(f);
        chooseRoute(f, id, fish, in, random);
        swim(f, id, neighbours[i], in);
    }
}

} // namespace shoal::game
