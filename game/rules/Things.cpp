#include "game/rules/Things.h"

#include "game/rules/FishBehaviour.h"
#include "game/rules/Grasping.h"
#include "game/rules/SharkBehaviour.h"

#include <algorithm>

namespace shoal::game {

namespace {

constexpr float kCrack_s = 0.5f;    // time until a held mussel cracks...
constexpr float kShowOpen_s = 0.6f; // ...and until it is let go after that
constexpr float kBait_s = 9;        // time for which it draws fish
constexpr float kThere_m = 0.18f;   // distance of a fish from its place at the hand at which it feeds
constexpr float kThrow_mps = 0.5f;  // a slower hand only lets go
constexpr float kAimed_mps = 4;     // least speed of an aimed throw at a target 1 m away...
constexpr float kAimedMax_mps = 9;  // ...and greatest at any distance
constexpr float kAimFar_m = 4;      // farthest target of an aimed throw
constexpr std::array<float, 3> kAim = {2, 0.94f, 0.82f}; // cosine of the angle that help bridges, by Assist
constexpr float kFrightens_mps = 1;                      // speed of a thrown thing that frightens fish...
constexpr float kFrightens_m = 0.3f;                     // ...at this distance
constexpr float kEyes_m = 0.45f;    // distance from the shark's snout at which a stone turns it away
constexpr float kSnout_m = 0.35f;   // distance from its mouth at which a strike is one on the snout
constexpr float kKnock_mps = 0.4f;  // slower knocks are silent
constexpr float kPushed = 0.4f;     // share of a thing's speed that it gives to a fish
constexpr float kBack_s = 12;       // time after which a thing that is out of view drifts again
constexpr float kInView = 0.3f;     // cosine of the angle from the middle of the view
constexpr float kSurface_m = 1.7f;  // height at which a bottle is out of reach and goes when nobody looks
constexpr float kThrowMax_mps = 12; // greatest speed of a throw
constexpr float kSpring_Hz = 0.8f;  // rate at which seaweed swings back to its place
constexpr float kForearm_m = 0.25f, kForearmRadius_m = 0.035f;

physics::LooseBody looseBody(const Fish& f, int id, const Species& kind) {
    return {.id = static_cast<uint32_t>(id),
            .radius = kind.bodyRadius_m,
            .half = kind.bodyHalf_m,
            .density_kgpm3 = kind.density_kgpm3,
            .drag = kind.drag,
            .position = f.position + f.separation * kDt,
            .velocity = f.push,
            .spin = f.spin,
            .worldFromBody = f.worldFromBody};
}

bool inView(glm::vec3 place, const DiveContext& in) {
    return glm::dot(normalizedOr(place - in.head(), in.state.view.ahead()), in.state.view.ahead()) > kInView;
}

// Returns the animal that a throw along `way` is meant for: the one nearest to it, or to the line of sight
// through the hand; empty: none is near enough.
const Swimmer* targetOf(glm::vec3 from, glm::vec3 way, const DiveContext& in) {
    const glm::vec3 sight = normalizedOr(from - in.head(), way);
    const Swimmer* best = nullptr;
    float nearest = kAim[static_cast<size_t>(in.assist)];
    const auto consider = [&](const Swimmer& animal, float bonus) {
        const glm::vec3 towards = normalizedOr(animal.position - from, way),
                        seen = normalizedOr(animal.position - in.head(), way);
        const float cosine = bonus + std::max(glm::dot(towards, way), glm::dot(seen, sight));
        if (cosine <= nearest || glm::distance(animal.position, from) > kAimFar_m) return;
        nearest = cosine;
        best = &animal;
    };
    if (in.state.shark.present && !in.hides(in.state.shark.position)) consider(in.state.shark, 0.05f);
    for (const Fish& f : in.state.fish)
        if (f.swims() && !in.hides(f.position)) consider(f, 0);
    return best;
}

// Returns the velocity of a throw that comes nearest to the target, which swims on. It simulates a throw,
// measures by how much this misses at its nearest point, corrects the aim by that, and repeats. ahead_m: how
// far ahead of the target's middle it aims.
glm::vec3 aimedAt(const Swimmer& target, float ahead_m, physics::LooseBody thing) {
    const glm::vec3 at = target.position + target.forward * ahead_m;
    const glm::vec3 from = thing.position;
    const float speed =
        std::min(kAimedMax_mps,
                 std::max(glm::length(thing.velocity), kAimed_mps * std::max(1.0f, glm::distance(at, from))));
    glm::vec3 aim = at;
    constexpr int kShots = 4, kTicks = 90;
    for (int shot = 0; shot < kShots; ++shot) {
        thing.position = from;
        thing.velocity = speed * normalizedOr(aim - from, {0, 0, -1});
        glm::vec3 miss = at - from;
        for (int i = 1; i <= kTicks; ++i) {
            thing.velocity = physics::inWater(thing, kDt);
            thing.position += thing.velocity * kDt;
            const glm::vec3 apart = at + target.velocity * (static_cast<float>(i) * kDt) - thing.position;
            if (glm::dot(apart, apart) < glm::dot(miss, miss)) miss = apart;
        }
        aim += miss;
    }
    return speed * normalizedOr(aim - from, {0, 0, -1});
}

// The film's surfaces at this time, and the floor of the dive.
physics::Ground groundOf(const DiveContext& in) {
    const auto triangles = [&in](glm::vec3 low, glm::vec3 high, const physics::Ground::Visit& visit) {
        const float y = in.dive.floor_m;
        if (low.y < y) {
            const glm::vec3 a(low.x - 1, y, low.z - 1), c(high.x + 1, y, high.z + 1);
            const glm::vec3 b(c.x, y, a.z), d(a.x, y, c.z);
            visit(a, c, b);
            visit(a, d, c);
        }
        if (in.film.known()) in.film.triangles(low, high, visit);
    };
    return {triangles, in.film.known() ? 0 : 0.6f};
}

void drift(Fish& f, const DiveContext& in) {
    const Species& kind = in.kindOf(f);
    if (kind.thing == Thing::Bottle) { // waits for its time, then comes up
        f.loose.time_s -= kDt;
        if (f.loose.time_s > 0) return;
        f.position = f.loose.home;
        f.position.y = in.dive.floor_m + kind.bodyRadius_m;
        f.position = in.film.pulledIn(f.position, capsuleOf(f, kind), FilmSpace::kFar_m);
        f.state = Fish::State::Loose;
        f.loose.time_s = 0;
        return;
    }
    const glm::vec3 was = f.position;
    f.push *= 1 - 2.5f * kDt;
    f.position +=
        (limited(f.push, kMaxSpeed_mps) + f.separation + kSpring_Hz * (f.loose.home - f.position)) * kDt;
    f.position = in.film.pulledIn(f.position, capsuleOf(f, kind), kMaxSpeed_mps * kDt);
    f.velocity = (f.position - was) / kDt;
    f.gait.advance(1);
}

// Sends a thing that has lain about unseen back to its place, and a bottle at the surface out of sight.
void comeBack(Fish& f, const DiveContext& in) {
    const Species& kind = in.kindOf(f);
    f.loose.time_s += kDt;
    const bool unseen = !inView(f.position, in);
    const bool lies = f.loose.time_s > kBack_s && unseen && !inView(f.loose.home, in);
    const bool isUp = kind.thing == Thing::Bottle && f.position.y > kSurface_m;
    if (lies || (isUp && unseen)) startDrifting(f, kind);
}

// Brings in a thing that a film's wall has overtaken, or that is below the floor; it loses its outward speed.
void stayInside(Fish& f, const Species& kind, const DiveContext& in) {
    const auto stop = [&](glm::vec3 out) { f.push -= out * std::max(0.0f, glm::dot(f.push, out)); };
    const float deep = in.film.known() ? 0.5f * kind.bodyRadius_m - in.film.surfaceGap_m(f.position) : 0;
    if (deep > 0) {
        const glm::vec3 outwards = normalizedOr(f.position, kUp);
        f.position -= outwards * std::min(deep, kMaxSpeed_mps * kDt);
        stop(outwards);
    }
    const float low = in.dive.floor_m + 0.5f * kind.bodyRadius_m;
    if (f.position.y >= low) return;
    f.position.y = low;
    stop(-kUp);
}

// A thrown thing frightens the fish near it, and a stone turns the shark away.
void frighten(Fish& f, std::span<Fish> fish, Shark& shark, const DiveContext& in, Random& random,
              Events& events) {
    if (!f.loose.thrown || glm::length(f.push) < kFrightens_mps) return;
    for (size_t i = 0; i < fish.size(); ++i)
        if (fish[i].state == Fish::State::Cruise && fish[i].flight.rest_s <= 0 &&
            physics::separation({f.position, f.position, 0}, capsuleOf(fish[i], in.kindOf(fish[i]))) <
                kFrightens_m)
            startle(fish[i], static_cast<int>(i), f.position, in, random, events);
    const bool heavy = in.thingOf(f) == Thing::Stone && shark.present;
    if (heavy && glm::distance(f.position, mouthOf(shark, in)) < kEyes_m) turnAway(shark, false, in, events);
}

void knock(const physics::Knock& k, std::span<Fish> fish, Shark& shark, const DiveContext& in, Random& random,
           Events& events) {
    Fish& f = fish[k.loose];
    if (k.closing_mps > kKnock_mps)
        events.push_back({.kind = EventKind::Knock,
                          .creature = static_cast<int>(k.loose),
                          .position = k.point,
                          .closing_mps = k.closing_mps});
    if (k.other < fish.size() && fish[k.other].swims()) {
        Fish& struck = fish[k.other];
        struck.push =
            limited(struck.push + kPushed * k.closing_mps * normalizedOr(struck.position - f.position, kUp),
                    kMaxSpeed_mps);
        startle(struck, static_cast<int>(k.other), f.position, in, random, events);
    } else if (k.other == fish.size() && shark.present && f.loose.thrown && in.thingOf(f) == Thing::Stone &&
               glm::distance(k.point, mouthOf(shark, in)) < kSnout_m)
        turnAway(shark, true, in, events);
}

} // namespace

void startDrifting(Fish& f, const Species& kind) {
    const bool first = f.state != Fish::State::Loose;
    if (first) f.loose.home = f.position;
    f.loose = {.home = f.loose.home};
    f.position = f.loose.home;
    f.push = f.velocity = f.separation = f.spin = glm::vec3(0);
    f.speed = f.uncatchable_s = 0;
    f.forward = normalizedOr({f.forward.x, 0, f.forward.z}, {0, 0, 1});
    f.worldFromBody = bodyTurn(f.forward, 0);
    f.state = Fish::State::Drift;
    f.gait.set(Motion::Drift);
    if (kind.thing != Thing::Bottle) return;
    // A bottle comes up some seconds into the dive, each at a time of its own.
    f.state = Fish::State::Gone;
    f.loose.time_s = first ? 5 + 10 * f.gait.phase_s : 10;
    f.gait.set(Motion::Detached);
}

float holdTime_s(const Species& kind) {
    return kind.thing == Thing::Stone ? 0 : kind.thing == Thing::Mussel ? kCrack_s : kind.hold_s;
}

void letGo(Fish& f, int id, const Hand& hand, int h, const DiveContext& in, Events& events) {
    f.heldBy = -1;
    f.state = Fish::State::Loose;
    f.hold.noPush_s = physics::kLoose_s;
    f.uncatchable_s = f.loose.spent ? kNever : 0.3f;
    f.loose.time_s = 0;
    f.push = limited((hand.trail.front() - hand.trail.back()) / (kThrowTicks * kDt), kThrowMax_mps);
    const float speed = glm::length(f.push);
    // A hand that the shark bumps drops it, and so does one at the end of the dive.
    const bool opens = hand.grip < kGripOpens && in.state.phase == Phase::Diving;
    f.loose.thrown = opens && !f.loose.spent && speed > kThrow_mps;
    f.spin = glm::vec3(0);
    if (f.loose.thrown && in.thingOf(f) == Thing::Stone && in.assist != Assist::None)
        if (const Swimmer* target = targetOf(f.position, f.push / speed, in)) {
            const Shark& shark = in.state.shark;
            const float ahead_m = target == &shark ? 0.4f * in.kindOf(shark).length_m : 0;
            f.push = aimedAt(*target, ahead_m, looseBody(f, id, in.kindOf(f)));
        }
    f.velocity = f.push;
    events.push_back({f.loose.thrown ? EventKind::Throw : EventKind::Release, id, h, f.position});
}

bool holdThing(Fish& f, int id, Hand& hand, int h, Score& score, const DiveContext& in, Events& events) {
    const Species& kind = in.kindOf(f);
    const glm::vec3 hollow = hand.hollow(kind.bodyRadius_m) - hand.graspCentre;
    f.hold.palmOffset += (glm::conjugate(hand.palm().orientation) * hollow - f.hold.palmOffset) * (20 * kDt);
    f.gait.advance(1);
    if (hand.solid && hand.grip < kGripOpens) return false;
    const bool due = f.hold.time_s >= holdTime_s(kind) + 0.5f * kDt;
    if (kind.thing == Thing::Mussel && due && !f.loose.spent) {
        f.loose.spent = true;
        f.gait.set(Motion::Open);
        hand.baitLeft_s = kBait_s;
        hand.fed = false;
        hand.nextVisit_s = 0;
        events.push_back({EventKind::Crack, id, h, f.position});
    }
    if (kind.thing == Thing::Bottle && due) {
        score.countThing(f.species, kind.points);
        events.push_back({.kind = EventKind::Collect,
                          .creature = id,
                          .hand = h,
                          .position = f.position,
                          .species = f.species,
                          .points = kind.points});
        hand.grasp.holds = hand.grasp.encloses = f.heldBy = -1;
        f.state = Fish::State::Gone;
        f.loose.time_s = kNever;
    }
    return !f.loose.spent || f.hold.time_s < kCrack_s + kShowOpen_s;
}

void offerBait(Hands& hands, std::span<const Fish> fish, bool& told, Events& events) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (hand.baitLeft_s <= 0) continue;
        if (hand.untrackedTicks > kHandDropTicks) hand.baitLeft_s = 0;
        hand.baitLeft_s = std::max(0.0f, hand.baitLeft_s - kDt);
        const auto eats = [&](const Fish& f) {
            return f.visit.hand == h && glm::distance(f.position, visitedPlace(hand)) < kThere_m;
        };
        const bool came = !hand.fed && std::ranges::any_of(fish, eats);
        hand.fed = hand.fed || came;
        const bool inVain = hand.baitLeft_s == 0 && !hand.fed && !told;
        told = told || inVain;
        if (came || inVain)
            events.push_back({came ? EventKind::Feed : EventKind::NoGuest, -1, h, hand.graspCentre});
    }
}

void ThingMover::move(physics::World& world, std::span<Fish> fish, Shark& shark, const DiveContext& in,
                      Random& random, Events& events) {
    loose_.clear();
    bodies_.clear();
    loose_.reserve(fish.size());
    bodies_.reserve(fish.size() + 3);
    knocks_.reserve(4 * fish.size());
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        if (f.state == Fish::State::Drift || f.state == Fish::State::Gone) {
            if (in.thingOf(f) != Thing::None) drift(f, in);
        } else if (f.state == Fish::State::Loose)
            loose_.push_back(looseBody(f, static_cast<int>(i), in.kindOf(f)));
        else if (f.swims() || f.state == Fish::State::Held)
            bodies_.push_back(bodyOf(f, i, in.kindOf(f)));
    }
    if (shark.present) bodies_.push_back(bodyOf(shark, fish.size(), in.kindOf(shark)));
    for (size_t h = 0; h < 2; ++h) { // their ids come after the shark's
        const Hand& hand = in.state.hands[h];
        if (!hand.solid) continue;
        const auto forearm = [](const Joints& joints) {
            const hands::Joint& wrist = joints[hands::kWristJoint];
            return physics::Capsule{wrist.position,
                                    wrist.position + wrist.orientation * glm::vec3(0, 0, kForearm_m),
                                    kForearmRadius_m};
        };
        bodies_.push_back({static_cast<uint32_t>(fish.size() + 1 + h), forearm(hand.before),
                           forearm(hand.joints), hand.velocity});
    }
    world.move(loose_, bodies_, groundOf(in), kDt, knocks_);
    for (const physics::LooseBody& b : loose_) {
        Fish& f = fish[b.id];
        const Species& kind = in.kindOf(f);
        f.push = b.velocity;
        f.spin = b.spin;
        f.worldFromBody = b.worldFromBody;
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        const glm::vec3 was = f.position;
        f.position = b.position;
        stayInside(f, kind, in);
        f.velocity = (f.position - was) / kDt;
        if (glm::length(f.push) < 0.5f * kFrightens_mps) f.loose.thrown = false;
        f.gait.advance(1);
    }
    for (const physics::Knock& k : knocks_) knock(k, fish, shark, in, random, events);
    for (const physics::Knock& k : knocks_) { // a knock ends a throw, but not one on a held fish or an arm
        const bool isArm = k.other != physics::kGroundId && k.other > fish.size();
        if (!isArm && (k.other >= fish.size() || fish[k.other].heldBy < 0))
            fish[k.loose].loose.thrown = false;
        if (k.other < fish.size()) fish[k.other].loose.thrown = false;
    }
    for (const physics::LooseBody& b : loose_) {
        frighten(fish[b.id], fish, shark, in, random, events);
        comeBack(fish[b.id], in);
    }
}

} // namespace shoal::game
