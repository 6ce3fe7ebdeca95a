// How fish swim.
#include "game/Steering.h"
#include "game/World.h"

namespace shoal::game {

namespace {

constexpr float kInner_m = 0.45f;     // no fish nearer to the vertical axis through the player
constexpr float kEyeRoom_m = 0.35f;   // no part of a fish nearer to the eyes
constexpr float kEyeShy_m = 0.45f;    // beyond that, it turns away
constexpr float kOuterSlack_m = 1.2f; // how far a frightened fish leaves its band
constexpr float kCeiling_m = 1.3f;
constexpr float kSharkShy_m = 0.95f;
constexpr float kSteepest = 0.42f;    // sine of the pitch while cruising...
constexpr float kSteepestDart = 0.6f; // ...and in flight

// A fast start: the body snaps into a C, away from the threat, and only then drives off. Domenici & Blake
// 1997, "The kinematics and performance of fish fast-start swimming": turns of 1 to 2 rad in 20 to 60 ms by
// fish of this size, then 40 to 100 m/s^2; both slowed here so that an eye can follow.
constexpr float kSnap_s = 0.07f;

// Where it wants to go and how fast. Velocities in m/s.
struct Wish {
    glm::vec3 way{0};
    float speed = 0;
};

// To its companions and along with them; how much faster to keep up.
void accompany(const Fish& f, const Species& kind, const Neighbours& around, Wish& wish) {
    if (around.aligned > 0) wish.way += normalizedOr(around.headings, f.forward) * (1.0f * f.cruise);
    if (around.attracted > 0) {
        const glm::vec3 towards = around.towards / static_cast<float>(around.attracted);
        const float reach = 3 * kind.spacing * kind.length_m;
        const glm::vec3 pull = limited(towards / reach, 1);
        wish.way += pull * (1.2f * f.cruise);
        // Who is behind hurries, who is ahead waits.
        wish.speed *= 1 + 0.5f * glm::dot(pull, f.forward);
    }
}

// Round the player's head.
void avoidEyes(const Fish& f, float length_m, Wish& wish) {
    const float distance = glm::length(f.position);
    const float room = distance - kEyeRoom_m - 0.5f * length_m;
    if (room < kEyeShy_m && distance > 1e-4f)
        wish.way += f.position / distance * (2.5f * (1 - room / kEyeShy_m) * std::max(f.cruise, f.speed));
}

} // namespace

void World::keepInBounds(Fish& f) {
    const School& school = file.schools[f.school];
    const Species& kind = species[f.species];
    const float outer = school.radiusHigh_m + kOuterSlack_m;
    const glm::vec3 flat(f.position.x, 0, f.position.z);
    const float radius = glm::length(flat);
    const glm::vec3 outward = radius > 1e-4f ? flat / radius : glm::vec3(0, 0, -1);
    const float kept = std::clamp(radius, kInner_m, outer);
    // Drawn back at no more than a brisk swim, so that nobody sees it jump.
    if (kept != radius) f.position += outward * std::clamp(kept - radius, -0.008f, 0.008f);
    const float room = kEyeRoom_m + 0.5f * kind.length_m - glm::length(f.position);
    if (room > 0) f.position += normalizedOr(f.position, outward) * std::min(room, 0.008f);
    const float low = file.floor_m + kind.bodyRadius_m + 0.04f;
    f.position.y = std::clamp(f.position.y, low, kCeiling_m);
}

void World::steer(Fish& f, size_t index) {
    const Species& kind = species[f.species];
    const bool darting = f.mind == Fish::Mind::Dart;
    const glm::vec3 flat(f.position.x, 0, f.position.z);
    const float radius = glm::length(flat);
    const glm::vec3 outward = radius > 1e-4f ? flat / radius : glm::vec3(0, 0, -1);
    const Neighbours& around = neighbours[index];

    choose(f, index);
    Wish wish;
    if (darting) {
        wish.way = f.flee * kind.dart_mps + outward * (radius < 0.6f ? 0.8f : 0.0f);
        wish.speed = kind.dart_mps * std::min(1.0f, 0.35f + f.dart_s);
        const float outer = file.schools[f.school].radiusHigh_m + 0.6f * kOuterSlack_m;
        if (radius > outer) wish.way -= outward * kind.dart_mps * 1.2f;
    } else {
        // Its circle: along it, and back to it.
        const float own = kind.company == Company::Alone ? 0.3f : 0.25f;
        wish.way = glm::cross(kUp, outward) * f.sense +
                   outward * std::clamp(1.5f * (f.radius - radius), -1.2f, 1.2f) +
                   kUp * std::clamp(1.5f * (f.height - f.position.y), -0.7f, 0.7f) + own * f.wander;
        wish.way *= f.cruise;
        wish.speed = f.cruise * f.pace;
        accompany(f, kind, around, wish);
    }
    f.push += around.push;
    avoidEyes(f, kind.length_m, wish);

    // A slow hand is merely swum around.
    for (const Hand& hand : hands) {
        if (!hand.visible || darting) continue;
        const glm::vec3 apart = f.position - hand.grasp;
        const float distance = glm::length(apart);
        if (distance < 0.25f && distance > 1e-4f)
            wish.way += apart / distance * (0.7f * f.cruise * (1 - distance / 0.25f));
    }
    bool afraid = darting;
    if (shark.present) {
        const float half = species[shark.species].bodyHalf_m;
        const float t = std::clamp(glm::dot(f.position - shark.position, shark.forward), -half, half);
        const glm::vec3 apart = f.position - (shark.position + shark.forward * t);
        const float distance = glm::length(apart);
        if (distance < kSharkShy_m && distance > 1e-4f) {
            const float fear = 1 - distance / kSharkShy_m;
            wish.way += apart / distance * (2.5f * fear * kind.dart_mps);
            wish.speed =
                std::max(wish.speed, std::min(kind.dart_mps, f.cruise + 2.2f * fear * kind.dart_mps));
            afraid = true;
        }
    }
    wish.way += around.giveWay * (afraid ? 3.5f : 1.0f);
    if (!afraid) // brakes for who is in its way
        wish.speed =
            std::max(0.3f * f.cruise, wish.speed + std::min(0.0f, glm::dot(around.giveWay, f.forward)));
    // Level out above the floor and below the ceiling before they are reached.
    const float firmly = 2 + 5 * f.speed;
    const float low = file.floor_m + 0.25f, high = kCeiling_m - 0.25f;
    if (f.position.y < low) wish.way.y += firmly * (low - f.position.y);
    if (f.position.y > high) wish.way.y -= firmly * (f.position.y - high);

    const glm::vec3 goal = levelled(normalizedOr(wish.way, f.forward), darting ? kSteepestDart : kSteepest);
    const bool snapping = f.flight_s > 0 && f.flight_s <= kSnap_s;
    const float turn = snapping ? 26.0f : darting ? 9.0f : afraid ? 1.8f * kind.turn_radps : kind.turn_radps;
    const float eager = snapping ? 24.0f : darting ? 14.0f : afraid ? 6.0f : 3.0f;
    const glm::vec3 spin = turnSmoothly(f.forward, f.spin, goal, eager, turn,
                                        snapping  ? 1200
                                        : darting ? 250
                                                  : 9 * turn,
                                        kDt);
    f.forward = levelled(f.forward, kSteepestDart);
    if (f.flightSide == 0 && f.flight_s > 0)
        f.flightSide = glm::dot(spin, kUp) < 0 || (glm::dot(spin, kUp) == 0 && index % 2) ? -1.0f : 1.0f;

    const float bankGoal = std::clamp(0.35f * glm::dot(f.spin, kUp), -0.7f, 0.7f);
    f.bank += (bankGoal - f.bank) * (5 * kDt);

    // Bursts and glides: Weihs 1974, "Energetic advantages of burst swimming of fish".
    if (afraid || !kind.coasts)
        f.coasting = false;
    else if (f.speed > 1.2f * wish.speed)
        f.coasting = true;
    else if (f.speed < 0.75f * wish.speed)
        f.coasting = false;
    if (snapping) return bendAndBeat(f, spin);
    // Sharp turns are swum slowly.
    if (!afraid) wish.speed *= 0.6f + 0.4f * std::max(0.0f, glm::dot(f.forward, goal));
    if (kind.coasts && !afraid) wish.speed *= f.coasting ? 0.0f : 1.35f;
    const float drag = f.coasting ? 0.9f * f.speed : std::max(1.2f, 0.8f * f.speed);
    const float drive = darting ? 22.0f : afraid ? 9.0f : 2.5f * f.cruise;
    f.speed = towards(f.speed, wish.speed, (wish.speed > f.speed ? drive : drag) * kDt);
    bendAndBeat(f, spin);
}

void World::swim() {
    lookAround();
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        f.uncatchable_s = std::max(0.0f, f.uncatchable_s - kDt);
        f.frightRest_s = std::max(0.0f, f.frightRest_s - kDt);
        if (f.mind == Fish::Mind::Held) struggle(f, hands[f.heldBy]);
        if (f.mind == Fish::Mind::Held || f.mind == Fish::Mind::Mouth) continue;
        if (f.mind == Fish::Mind::Dart && (f.dart_s -= kDt) <= 0) f.mind = Fish::Mind::Cruise;
        f.flight_s = f.mind == Fish::Mind::Dart ? f.flight_s + kDt : 0;
        if (f.flight_s == 0) f.flightSide = 0;

        steer(f, i);
        f.push *= 1 - 2.5f * kDt; // water stops what was pushed within a second
        f.push = limited(f.push, kMaxSpeed_mps);
        const glm::vec3 goal = limited(f.forward * f.speed + f.push + f.parting, kMaxSpeed_mps);
        const glm::vec3 from = f.position;
        f.position += goal * kDt;
        keepInBounds(f);
        f.velocity = limited((f.position - from) / kDt, kMaxSpeed_mps);
        f.worldFromBody = bodyTurn(f.forward, f.bank);

        const bool hurried = f.mind == Fish::Mind::Dart || f.speed > 2.2f * f.cruise;
        f.gait.set(hurried ? Motion::Dart : Motion::Swim);
        // Fins row while the body hovers or brakes, and rest while it glides.
        const float pace = f.speed / species[f.species].cruise_mps;
        f.gait.advance(f.coasting ? 0.5f : pace < 0.6f ? 1.4f : 1.0f);
    }
}

} // namespace shoal::game
