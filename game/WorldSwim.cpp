// How fish swim.
#include "game/Steering.h"
#include "game/World.h"

namespace shoal::game {

namespace {

constexpr float kInner_m = 0.45f;     // no fish nearer to the vertical axis through the player
constexpr float kOuterSlack_m = 1.2f; // how far a frightened fish leaves its band
constexpr float kCeiling_m = 1.3f;
constexpr float kSharkShy_m = 0.95f;

// Distance at which two fish start to give way, centre to centre.
float roomBetween(const Species& a, const Species& b) { return 0.45f * (a.length_m + b.length_m) + 0.08f; }

} // namespace

void World::keepApart(size_t index, glm::vec3& desired) {
    Fish& f = fish[index];
    const Species& kind = species[f.species];
    for (size_t j = 0; j < fish.size(); ++j) {
        const Fish& other = fish[j];
        if (j == index || other.mind == Fish::Mind::Held || other.mind == Fish::Mind::Mouth) continue;
        const float room = roomBetween(kind, species[other.species]);
        const glm::vec3 apart = f.position - other.position;
        const float squared = glm::dot(apart, apart);
        // Look ahead as well: who will be too near in half a second?
        const glm::vec3 soon = apart + 0.5f * (f.velocity - other.velocity);
        const float soonSquared = glm::dot(soon, soon);
        const float nearest = std::min(squared, soonSquared);
        if (nearest >= room * room) continue;
        const float distance = std::sqrt(squared);
        const glm::vec3 away = distance > 1e-4f ? apart / distance : glm::vec3(0, index < j ? -1 : 1, 0);
        const float urgency = 1 - std::sqrt(nearest) / room;
        desired += away * (1.8f * urgency * std::max(kind.cruise_mps, f.speed));
        // Steering comes too late for bodies that already touch: a soft push.
        const float touching = 0.8f * room;
        if (distance < touching) f.push += away * (6.0f * (1 - distance / touching) * kDt);
    }
}

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
    const float low = file.floor_m + kind.bodyRadius_m + 0.04f;
    f.position.y = std::clamp(f.position.y, low, kCeiling_m);
}

void World::steer(Fish& f, size_t index) {
    const Species& kind = species[f.species];
    const bool darting = f.mind == Fish::Mind::Dart;
    const glm::vec3 flat(f.position.x, 0, f.position.z);
    const float radius = glm::length(flat);
    const glm::vec3 outward = radius > 1e-4f ? flat / radius : glm::vec3(0, 0, -1);

    if (--f.wanderTicks <= 0) {
        f.wanderGoal = {random.between(-1, 1), random.between(-0.6f, 0.6f), random.between(-1, 1)};
        f.wanderTicks = 60 + static_cast<int>(random.below(180));
    }
    f.wander += (f.wanderGoal - f.wander) * (1.2f * kDt);

    // Its circle: along it, and back to it.
    const glm::vec3 along = glm::cross(kUp, outward) * f.sense;
    glm::vec3 desired = along + outward * std::clamp(1.5f * (f.radius - radius), -0.9f, 0.9f) +
                        kUp * std::clamp(1.5f * (f.height - f.position.y), -0.5f, 0.5f) + 0.3f * f.wander;
    desired *= f.cruise;
    float goalSpeed = f.cruise;
    if (darting) {
        desired = f.flee * kind.dart_mps + outward * (radius < 0.6f ? 0.8f : 0.0f);
        goalSpeed = kind.dart_mps * std::min(1.0f, 0.35f + f.dart_s);
        const float outer = file.schools[f.school].radiusHigh_m + 0.6f * kOuterSlack_m;
        if (radius > outer) desired -= outward * kind.dart_mps * 1.2f;
    }
    keepApart(index, desired);

    // A slow hand is merely swum around.
    for (const Hand& hand : hands) {
        if (!hand.visible || darting) continue;
        const glm::vec3 apart = f.position - hand.grasp;
        const float distance = glm::length(apart);
        if (distance < 0.25f && distance > 1e-4f)
            desired += apart / distance * (0.35f * f.cruise * (1 - distance / 0.25f));
    }
    if (shark.present) {
        const float half = species[shark.species].bodyHalf_m;
        const float t = std::clamp(glm::dot(f.position - shark.position, shark.forward), -half, half);
        const glm::vec3 apart = f.position - (shark.position + shark.forward * t);
        const float distance = glm::length(apart);
        if (distance < kSharkShy_m && distance > 1e-4f) {
            const float fear = 1 - distance / kSharkShy_m;
            desired += apart / distance * (2.5f * fear * kind.dart_mps);
            goalSpeed = std::max(goalSpeed, std::min(kind.dart_mps, f.cruise + 2.2f * fear * kind.dart_mps));
        }
    }
    // Level out above the floor and below the ceiling before they are reached.
    const float low = file.floor_m + 0.25f;
    if (f.position.y < low) desired.y += 2 * (low - f.position.y);
    if (f.position.y > kCeiling_m - 0.2f) desired.y -= 2 * (f.position.y - kCeiling_m + 0.2f);

    const float steepest = darting ? 0.6f : 0.42f;
    const glm::vec3 goal = levelled(normalizedOr(desired, f.forward), steepest);
    const float across = glm::length(goal - f.forward);
    const float turn = darting ? 9.0f : kind.turn_radps;
    const float eager = darting ? 14.0f : 3.0f; // 1/s: slower as it comes near, so headings do not tick
    const glm::vec3 was = f.forward;
    f.forward = levelled(turnedTowards(was, goal, std::min(turn, eager * across) * kDt), steepest);

    const float yawRate = glm::dot(f.forward - was, leftOf(was)) / kDt;
    const float bankGoal = std::clamp(0.35f * yawRate, -0.7f, 0.7f);
    f.bank += (bankGoal - f.bank) * (5 * kDt);

    f.speed = towards(f.speed, goalSpeed, (goalSpeed > f.speed ? 9.0f : 1.2f) * kDt);
}

void World::swim() {
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        f.uncatchable_s = std::max(0.0f, f.uncatchable_s - kDt);
        f.frightRest_s = std::max(0.0f, f.frightRest_s - kDt);
        if (f.mind == Fish::Mind::Held || f.mind == Fish::Mind::Mouth) continue;
        if (f.mind == Fish::Mind::Dart && (f.dart_s -= kDt) <= 0) f.mind = Fish::Mind::Cruise;

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
        const float pace = f.speed / (hurried ? species[f.species].dart_mps : species[f.species].cruise_mps);
        f.gait.advance(std::clamp(pace, 0.6f, 2.0f));
    }
}

} // namespace shoal::game
