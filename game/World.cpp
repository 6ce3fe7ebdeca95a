#include "game/World.h"

#include "game/Steering.h"

namespace shoal::game {

void Gait::set(Motion next) {
    if (next == motion) return;
    before = motion;
    motion = next;
    blend = 0;
}

void Gait::advance(float rate) {
    constexpr float kBlend_s = 0.2f;
    phase_s += kDt * rate;
    blend = std::min(1.0f, blend + kDt / kBlend_s);
}

World::World(SpeciesTable s, DiveFile f, uint64_t firstSeed) : species(std::move(s)), file(std::move(f)) {
    size_t count = 0;
    for (const School& school : file.schools) count += static_cast<size_t>(school.count);
    fish.reserve(count);
    neighbours.resize(count);
    bodies.reserve(count + 1);
    movers.reserve(2 * hands::kJointCount);
    contacts.reserve((count + 1) * movers.capacity());
    lastContacts.reserve(contacts.capacity());
    begin(firstSeed);
}

namespace {

// A direction on the unit circle without trigonometry: rejection from the square.
glm::vec3 randomAround(Random& random) {
    for (;;) {
        const float x = random.between(-1, 1), z = random.between(-1, 1);
        const float squared = x * x + z * z;
        if (squared > 0.01f && squared <= 1) return glm::vec3(x, 0, z) / std::sqrt(squared);
    }
}

// Fish of one school mostly go round the same way; companions start beside their leader.
Fish spawn(const School& school, int schoolIndex, const Species& kind, float mainSense, const Fish* leader,
           Random& random) {
    Fish fish;
    fish.species = school.species;
    fish.school = schoolIndex;
    fish.radius = random.between(school.radiusLow_m, school.radiusHigh_m);
    fish.height = random.between(school.heightLow_m, school.heightHigh_m);
    fish.cruise = kind.cruise_mps * random.between(0.8f, 1.25f);
    fish.sense = random.unit() < 0.8f ? mainSense : -mainSense;
    fish.wanderTicks = 1 + static_cast<int>(random.below(200));
    fish.routeTicks = 600 + static_cast<int>(random.below(1200));
    glm::vec3 outward = randomAround(random);
    fish.position = outward * fish.radius + glm::vec3(0, fish.height, 0);
    if (leader) {
        fish.radius = leader->radius;
        fish.height = leader->height;
        fish.sense = leader->sense;
        fish.cruise = leader->cruise;
        const float around = 2.2f * kind.spacing * kind.length_m;
        fish.position =
            leader->position +
            around * glm::vec3(random.between(-1, 1), random.between(-0.7f, 0.7f), random.between(-1, 1));
        fish.position.y = std::clamp(fish.position.y, school.heightLow_m, school.heightHigh_m);
        outward = normalizedOr({fish.position.x, 0, fish.position.z}, outward);
    }
    fish.forward = glm::cross(kUp, outward) * fish.sense;
    fish.speed = fish.cruise;
    fish.velocity = fish.forward * fish.speed;
    fish.worldFromBody = bodyTurn(fish.forward, 0);
    fish.gait.phase_s = random.between(0, 2);
    return fish;
}

} // namespace

void World::begin(uint64_t newSeed) {
    seed = newSeed;
    random = Random(seed, 1);
    tick = 0;
    phase = Phase::Diving;
    begun = false;
    score = caught = lost = 0;
    for (Hand& hand : hands) {
        hand.holds = -1;
        hand.window = 0;
    }
    contacts.clear();
    fish.clear();
    for (size_t i = 0; i < file.schools.size(); ++i) {
        const School& school = file.schools[i];
        const float mainSense = random.unit() < 0.5f ? 1.0f : -1.0f;
        const Company company = species[school.species].company;
        int leads = -1;
        for (int n = 0; n < school.count; ++n) {
            const bool joins = company == Company::Shoal ? n > 0 : company == Company::Pair && n % 2;
            const int index = static_cast<int>(fish.size());
            if (!joins) leads = index;
            // A few tries for a place with room around it.
            Fish best;
            float bestRoom = -1;
            for (int attempt = 0; attempt < 12; ++attempt) {
                const Fish candidate = spawn(school, static_cast<int>(i), species[school.species], mainSense,
                                             joins ? &fish[leads] : nullptr, random);
                float room = 10;
                for (const Fish& other : fish)
                    room = std::min(room, glm::distance(candidate.position, other.position));
                if (room <= bestRoom) continue;
                best = candidate;
                best.leader = leads;
                bestRoom = room;
            }
            fish.push_back(best);
        }
    }

    shark = Shark{};
    shark.present = file.shark.species >= 0;
    if (shark.present) {
        shark.species = file.shark.species;
        const Species& kind = species[shark.species];
        const glm::vec3 outward = randomAround(random);
        shark.sense = random.unit() < 0.5f ? 1.0f : -1.0f;
        shark.position = outward * file.shark.radius_m + glm::vec3(0, file.shark.height_m, 0);
        shark.forward = glm::cross(kUp, outward) * shark.sense;
        shark.speed = kind.cruise_mps;
        shark.velocity = shark.forward * shark.speed;
        shark.worldFromBody = bodyTurn(shark.forward, 0);
        shark.gait.motion = shark.gait.before = Motion::Cruise;
    }
}

void World::emit(std::vector<Event>& out, Event::Kind kind, int creature, int hand, int finger,
                 float strength, glm::vec3 position) const {
    Event event;
    event.kind = kind;
    event.tick = totalTicks;
    event.creature = creature;
    event.hand = hand;
    event.finger = finger;
    event.strength = strength;
    event.position = position;
    out.push_back(event);
}

void World::step(const TickInput& input, std::vector<Event>& out) {
    const bool restart = input.restart && !restartHeld;
    restartHeld = input.restart;
    if (restart) begin(seed + 1);
    paused = input.pause;
    if (paused && begun) return;

    ++totalTicks;
    ++tick;
    if (!begun) {
        begun = true;
        emit(out, Event::Kind::DiveStart);
    }
    readHands(input);
    frightenByHands(out);
    followHands();
    touch(out);
    closeHands(out);
    swim();
    swimShark(out);
    carry(out);

    const auto lastTick = static_cast<uint32_t>(file.duration_s * sim::kTickRate_Hz);
    if (phase == Phase::Diving && tick >= lastTick) {
        for (int hand = 0; hand < 2; ++hand)
            if (hands[hand].holds >= 0) drop(hand, out);
        phase = Phase::Results;
        emit(out, Event::Kind::DiveOver);
    }
}

} // namespace shoal::game
