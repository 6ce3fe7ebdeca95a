#include "game/rules/Spawn.h"

#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

namespace {

// Returns a random unit vector in the level plane, without trigonometry: rejection from the square.
glm::vec3 randomAround(Random& random) {
    for (;;) {
        const float x = random.between(-1, 1), z = random.between(-1, 1);
        const float squared = x * x + z * z;
        if (squared > 0.01f && squared <= 1) return glm::vec3(x, 0, z) / std::sqrt(squared);
    }
}

// Makes a fish. Most fish of a school circle the same way; companions start beside their leader.
Fish spawnOne(const School& school, int schoolIndex, const Species& kind, float mainDirection,
              const Fish* leader, Random& random) {
    Fish fish;
    fish.species = school.species;
    fish.school = schoolIndex;
    Route& route = fish.route;
    route.radius = random.between(school.radiusLow_m, school.radiusHigh_m);
    route.height = random.between(school.heightLow_m, school.heightHigh_m);
    route.cruise_mps = kind.cruise_mps * random.between(0.8f, 1.25f);
    route.direction = random.unit() < 0.8f ? mainDirection : -mainDirection;
    route.wanderTicks = 1 + static_cast<int>(random.below(200));
    route.changeTicks = 600 + static_cast<int>(random.below(1200));
    glm::vec3 outward = randomAround(random);
    glm::vec3 position = outward * route.radius + glm::vec3(0, route.height, 0);
    if (leader) {
        route.follow(leader->route);
        route.cruise_mps = leader->route.cruise_mps;
        // One draw a statement: the order in which arguments are evaluated is the compiler's choice.
        const float z = random.between(-1, 1), y = random.between(-0.7f, 0.7f), x = random.between(-1, 1);
        position = leader->position + 2.2f * kind.spacing * kind.length_m * glm::vec3(x, y, z);
        position.y = std::clamp(position.y, school.heightLow_m, school.heightHigh_m);
        outward = normalizedOr({position.x, 0, position.z}, outward);
    }
    startCircling(fish, position, outward, route.direction, route.cruise_mps);
    fish.gait.phase_s = random.between(0, 2);
    return fish;
}

// Returns, of twelve random fish, the one farthest from all others.
Fish spawnWithRoom(const DiveFiles& files, int schoolIndex, float mainDirection, const Fish* leader,
                   const std::vector<Fish>& others, Random& random) {
    const School& school = files.dive.schools[schoolIndex];
    Fish best;
    float bestRoom = -1;
    for (int attempt = 0; attempt < 12; ++attempt) {
        const Fish candidate =
            spawnOne(school, schoolIndex, files.species[school.species], mainDirection, leader, random);
        float room = 10;
        for (const Fish& other : others)
            room = std::min(room, glm::distance(candidate.position, other.position));
        if (room <= bestRoom) continue;
        best = candidate;
        bestRoom = room;
    }
    return best;
}

} // namespace

void spawnFish(const DiveFiles& files, Random& random, std::vector<Fish>& out) {
    out.clear();
    for (size_t i = 0; i < files.dive.schools.size(); ++i) {
        const School& school = files.dive.schools[i];
        const float mainDirection = random.unit() < 0.5f ? 1.0f : -1.0f;
        const Company company = files.species[school.species].company;
        int leader = -1;
        for (int n = 0; n < school.count; ++n) {
            const bool joins = company == Company::Shoal ? n > 0 : company == Company::Pair && n % 2;
            if (!joins) leader = static_cast<int>(out.size());
            Fish fish = spawnWithRoom(files, static_cast<int>(i), mainDirection,
                                      joins ? &out[leader] : nullptr, out, random);
            fish.route.leader = leader;
            out.push_back(fish);
        }
    }
}

Shark spawnShark(const DiveFiles& files, Random& random) {
    const SharkPlan& plan = files.dive.shark;
    Shark shark;
    shark.present = plan.species >= 0;
    if (!shark.present) return shark;
    shark.species = plan.species;
    const glm::vec3 outward = randomAround(random);
    shark.direction = random.unit() < 0.5f ? 1.0f : -1.0f;
    startCircling(shark, outward * plan.radius_m + glm::vec3(0, plan.height_m, 0), outward, shark.direction,
                  files.species[shark.species].cruise_mps);
    shark.gait.motion = shark.gait.before = Motion::Cruise;
    return shark;
}

} // namespace shoal::game
