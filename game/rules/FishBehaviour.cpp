#include "game/rules/FishBehaviour.h"

#include "game/rules/Steering.h"

#include <algorithm>
#include <cmath>

namespace shoal::game {

namespace {

constexpr float kOrientation = 3;   // zone's radius in spacings
constexpr float kAttraction = 1.6f; // begins here
constexpr float kSight_m = 1.1f;    // strangers farther away do not matter
constexpr float kTouch_m = 0.04f;   // gap between bodies below which they push each other
constexpr float kForesee_s = 0.5f;  // who will be too near so soon is avoided now

// Distance at which two strangers start to give way, centre to centre.
float roomBetween(const Species& a, const Species& b) { return 0.45f * (a.length_m + b.length_m) + 0.08f; }

// What one of two fish has to do to keep its room from the other; gap: between the bodies, metres.
void giveWay(const Fish& f, const Species& kind, glm::vec3 away, float gap, float urgency, Neighbours& out) {
    const float pace = std::max(kind.cruise_mps, f.speed);
    out.giveWay += away * (1.8f * urgency * pace);
    if (gap < kTouch_m)
        out.push += away * (8.0f * (pace / kind.cruise_mps) * std::min(1 - gap / kTouch_m, 2.0f) * kDt);
}

void accompany(const Fish& other, glm::vec3 towards, float distance, float spacing, Neighbours& out) {
    if (distance < kOrientation * spacing) {
        out.headings += other.forward;
        ++out.aligned;
    }
    if (distance > kAttraction * spacing) {
        out.towards += towards;
        ++out.attracted;
    }
}

void gatherPair(const Fish& a, const Species& kindA, Neighbours& ofA, const Fish& b, const Species& kindB,
                Neighbours& ofB) {
    const bool companions = a.leader == b.leader;
    const glm::vec3 apart = a.position - b.position;
    const float squared = glm::dot(apart, apart);
    if ((!companions && squared > kSight_m * kSight_m) || !b.free()) return;
    const float spacing = kindA.spacing * kindA.length_m;
    const float room = companions ? spacing : roomBetween(kindA, kindB);
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

} // namespace

void gatherNeighbours(std::span<const Fish> fish, const SpeciesTable& species, std::span<Neighbours> out) {
    std::fill(out.begin(), out.end(), Neighbours{});
    for (size_t i = 0; i < fish.size(); ++i) {
        if (!fish[i].free()) continue;
        for (size_t j = 0; j < i; ++j)
            gatherPair(fish[i], species[fish[i].species], out[i], fish[j], species[fish[j].species], out[j]);
    }
}

void chooseRoute(Fish& f, int id, std::span<const Fish> fish, const School& school, const Species& kind,
                 Random& random) {
    const bool leads = f.leader == id;
    if (--f.wanderTicks <= 0) {
        f.wanderGoal = {random.between(-1, 1), random.between(-0.6f, 0.6f), random.between(-1, 1)};
        f.wanderTicks = 60 + static_cast<int>(random.below(180));
        // Who lives alone has time: it stops to look around.
        const bool lingers = kind.company == Company::Alone && random.unit() < 0.15f;
        f.pace = lingers ? 0.2f : 1.0f;
    }
    f.wander += (f.wanderGoal - f.wander) * (1.2f * kDt);
    if (leads && --f.routeTicks <= 0) {
        f.radius = random.between(school.radiusLow_m, school.radiusHigh_m);
        f.height = random.between(school.heightLow_m, school.heightHigh_m);
        if (random.unit() < 0.25f) f.sense = -f.sense;
        f.routeTicks = 600 + static_cast<int>(random.below(1200));
    } else if (!leads) {
        const Fish& leader = fish[f.leader];
        f.radius = leader.radius;
        f.height = leader.height;
        f.sense = leader.sense;
    }
}

void startle(Fish& f, int id, glm::vec3 from, Random& random, Events& events) {
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
    events.push_back({.kind = EventKind::Startle, .creature = id, .position = f.position});
}

void frightenByHands(const Hands& hands, const SpeciesTable& species, std::span<Fish> fish, Random& random,
                     Events& events) {
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
