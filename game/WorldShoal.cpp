// Whom a fish keeps company with: zones of repulsion, orientation and attraction around each, as in Couzin,
// Krause, James, Ruxton & Franks 2002, "Collective memory and spatial sorting in animal groups"; here their
// edges are soft and forces add, so that headings do not jump as a neighbour crosses an edge.
#include "game/Steering.h"
#include "game/World.h"

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

physics::Capsule bodyOf(const Fish& f, const Species& kind) {
    const glm::vec3 half = f.forward * kind.bodyHalf_m;
    return {f.position - half, f.position + half, kind.bodyRadius_m};
}

} // namespace

void World::lookAround() {
    std::fill(neighbours.begin(), neighbours.end(), Neighbours{});
    const auto gone = [](const Fish& f) { return f.mind == Fish::Mind::Held || f.mind == Fish::Mind::Mouth; };
    for (size_t i = 0; i < fish.size(); ++i) {
        const Fish& a = fish[i];
        if (gone(a)) continue;
        const Species& kindA = species[a.species];
        for (size_t j = 0; j < i; ++j) {
            const Fish& b = fish[j];
            const bool companions = a.leader == b.leader;
            const glm::vec3 apart = a.position - b.position;
            const float squared = glm::dot(apart, apart);
            if ((!companions && squared > kSight_m * kSight_m) || gone(b)) continue;
            const Species& kindB = species[b.species];
            const float spacing = kindA.spacing * kindA.length_m;
            const float room = companions ? spacing : roomBetween(kindA, kindB);
            const float distance = std::sqrt(squared);
            const glm::vec3 soon = apart + kForesee_s * (a.velocity - b.velocity);
            const float nearest = std::min(distance, glm::length(soon));
            if (nearest < room) {
                const glm::vec3 away = distance > 1e-4f ? apart / distance : glm::vec3(0, -1, 0);
                const float gap =
                    distance < room ? physics::separation(bodyOf(a, kindA), bodyOf(b, kindB)) : room;
                giveWay(a, kindA, away, gap, 1 - nearest / room, neighbours[i]);
                giveWay(b, kindB, -away, gap, 1 - nearest / room, neighbours[j]);
            }
            if (!companions) continue;
            const auto accompany = [&](const Fish& other, glm::vec3 towards, Neighbours& out) {
                if (distance < kOrientation * spacing) {
                    out.headings += other.forward;
                    out.speeds += other.speed;
                    ++out.aligned;
                }
                if (distance > kAttraction * spacing) {
                    out.towards += towards;
                    ++out.attracted;
                }
            };
            accompany(b, -apart, neighbours[i]);
            accompany(a, apart, neighbours[j]);
        }
    }
}

// Where it wants to go for the next while. Companions follow their leader's choice.
void World::choose(Fish& f, size_t index) {
    const School& school = file.schools[f.school];
    const Species& kind = species[f.species];
    const bool leads = f.leader == static_cast<int>(index);
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

} // namespace shoal::game
