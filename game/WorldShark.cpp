// The shark: far circles, visits, strikes at what a hand holds.
#include "game/Steering.h"
#include "game/World.h"

namespace shoal::game {

namespace {

constexpr float kJaws_m = 0.28f;      // how near its mouth must come to take a fish
constexpr float kEyeRoom_m = 0.55f;   // no part of its axis comes nearer to the player's eyes
constexpr float kStrikeTime_s = 2.5f; // then it gives up
constexpr float kCarryTo_m = 3.6f;    // where it loses what it took
constexpr float kTempted = 4;         // seconds of struggling that bring it early
constexpr float kStrikeFrom_m = 3.0f; // farther away it does not try

} // namespace

void World::setMind(Shark::Mind mind) {
    shark.mind = mind;
    shark.mind_s = 0;
}

glm::vec3 World::mouthPosition() const {
    return shark.position + shark.forward * (0.46f * species[shark.species].length_m);
}

void World::steal(int index, std::vector<Event>& out) {
    Fish& f = fish[index];
    const int h = f.heldBy;
    hands[h].holds = -1;
    f.heldBy = -1;
    f.mind = Fish::Mind::Mouth;
    shark.mouth = index;
    shark.prey = -1;
    ++lost;
    emit(out, Event::Kind::SharkSteal, index, h, -1, glm::length(shark.velocity), f.position);
    setMind(Shark::Mind::Leave);
    shark.visit_s = 0;
    shark.gait.set(Motion::Bite);
}

void World::sharkMind(std::vector<Event>& out) {
    using Mind = Shark::Mind;
    shark.mind_s += kDt;
    int struggling = -1;
    for (const Hand& hand : hands)
        if (hand.holds >= 0 && !fish[hand.holds].counted && fish[hand.holds].held_s > 0.12f)
            struggling = hand.holds;
    shark.interest = struggling >= 0 ? shark.interest + kDt : std::max(0.0f, shark.interest - 0.03f * kDt);

    const auto visit = [&] {
        setMind(Mind::Prowl);
        shark.visit_s = file.shark.visitLength_s;
        shark.interest = 0;
        emit(out, Event::Kind::SharkNear, sharkId(), -1, -1, 0, shark.position);
    };
    const float time_s = static_cast<float>(tick) * kDt;
    switch (shark.mind) {
    case Mind::Circle: {
        const auto& visits = file.shark.visits_s;
        const bool due = shark.nextVisit < visits.size() && time_s >= visits[shark.nextVisit];
        if (due) ++shark.nextVisit;
        if (phase == Phase::Diving && (due || (shark.interest > kTempted && shark.mind_s > 8))) visit();
        break;
    }
    case Mind::Prowl:
        shark.visit_s -= kDt;
        if (struggling >= 0 && glm::distance(mouthPosition(), fish[struggling].position) < kStrikeFrom_m) {
            shark.prey = struggling;
            setMind(Mind::Strike);
        } else if (shark.visit_s <= 0)
            setMind(Mind::Leave);
        break;
    case Mind::Strike:
        if (fish[shark.prey].mind != Fish::Mind::Held || fish[shark.prey].counted ||
            shark.mind_s > kStrikeTime_s) {
            shark.prey = -1;
            setMind(shark.visit_s > 0 ? Mind::Prowl : Mind::Leave);
        }
        break;
    case Mind::Leave: {
        const float away = glm::length(glm::vec3(shark.position.x, 0, shark.position.z));
        if (away > file.shark.radius_m - 0.6f || shark.mind_s > 15) setMind(Mind::Circle);
        break;
    }
    }
}

void World::sharkMove() {
    using Mind = Shark::Mind;
    const Species& kind = species[shark.species];
    const glm::vec3 flat(shark.position.x, 0, shark.position.z);
    const float radius = glm::length(flat);
    const glm::vec3 outward = radius > 1e-4f ? flat / radius : glm::vec3(0, 0, -1);
    const glm::vec3 along = glm::cross(kUp, outward) * shark.sense;

    const float circle = shark.mind == Mind::Prowl ? file.shark.prowlRadius_m : file.shark.radius_m;
    const float height = shark.mind == Mind::Prowl ? 0.5f * file.shark.height_m : file.shark.height_m;
    glm::vec3 desired = along + outward * std::clamp(1.8f * (circle - radius), -1.4f, 1.4f) +
                        kUp * std::clamp(0.8f * (height - shark.position.y), -0.4f, 0.4f);
    float goalSpeed = kind.cruise_mps;
    float turn = kind.turn_radps;
    switch (shark.mind) {
    case Mind::Circle:
        break;
    case Mind::Prowl:
        goalSpeed = radius > circle + 0.8f ? 1.6f * kind.cruise_mps : 1.15f * kind.cruise_mps;
        turn *= 1.4f;
        break;
    case Mind::Strike: {
        const glm::vec3 to = fish[shark.prey].position - mouthPosition();
        const float distance = glm::length(to);
        desired = fish[shark.prey].position - shark.position;
        // Turn first, then dash; brake so as to snap rather than ram.
        const float aimed = std::max(0.0f, glm::dot(shark.forward, normalizedOr(desired, shark.forward)));
        goalSpeed =
            kind.dart_mps * std::clamp(aimed * aimed, 0.25f, 1.0f) * std::clamp(0.3f + distance, 0.4f, 1.0f);
        turn = 4;
        break;
    }
    case Mind::Leave:
        desired += outward * 1.2f;
        goalSpeed = glm::dot(shark.forward, outward) > 0.2f ? 1.7f * kind.cruise_mps : 0.6f * kind.cruise_mps;
        turn *= 2.6f;
        break;
    }

    // Round the player's head, not through it.
    const glm::vec3 nose = mouthPosition();
    const float noseRoom = glm::length(nose);
    if (noseRoom < 1.1f && shark.mind != Mind::Strike) {
        desired += nose / std::max(noseRoom, 0.05f) * (2.5f * (1.1f - noseRoom));
        if (glm::dot(shark.forward, nose) < 0) goalSpeed = std::min(goalSpeed, 0.5f * kind.cruise_mps);
    }

    const glm::vec3 goal = levelled(normalizedOr(desired, shark.forward), 0.35f);
    const float across = glm::length(goal - shark.forward);
    const glm::vec3 was = shark.forward;
    shark.forward = levelled(turnedTowards(was, goal, std::min(turn, 2.5f * turn * across) * kDt), 0.35f);
    const float yawRate = glm::dot(shark.forward - was, leftOf(was)) / kDt;
    shark.bank += (std::clamp(0.3f * yawRate, -0.6f, 0.6f) - shark.bank) * (3 * kDt);
    shark.speed = towards(shark.speed, goalSpeed, (goalSpeed > shark.speed ? 5.0f : 3.0f) * kDt);

    const glm::vec3 from = shark.position;
    shark.position += shark.forward * shark.speed * kDt;
    // Whatever happened: its axis keeps clear of the eyes.
    const float reach = 0.46f * kind.length_m;
    const float t = std::clamp(-glm::dot(shark.position, shark.forward), -reach, reach);
    const glm::vec3 nearest = shark.position + shark.forward * t;
    const float room = glm::length(nearest);
    if (room < kEyeRoom_m)
        shark.position += normalizedOr(nearest, outward) * std::min(kEyeRoom_m - room, 2.0f * kDt);
    shark.position.y = std::max(shark.position.y, file.floor_m + kind.bodyRadius_m + 0.05f);
    shark.velocity = (shark.position - from) / kDt;
    shark.worldFromBody = bodyTurn(shark.forward, shark.bank);
}

void World::swimShark(std::vector<Event>& out) {
    if (!shark.present) return;
    shark.bumpRest_s = std::max(0.0f, shark.bumpRest_s - kDt);
    sharkMind(out);
    sharkMove();
    if (shark.mind == Shark::Mind::Strike &&
        glm::distance(mouthPosition(), fish[shark.prey].position) < kJaws_m)
        steal(shark.prey, out);

    if (shark.mouth >= 0) {
        Fish& f = fish[shark.mouth];
        const glm::vec3 was = f.position;
        const glm::vec3 at = mouthPosition() - 0.05f * kUp;
        f.position += (at - f.position) * 0.3f;
        f.velocity = (f.position - was) / kDt;
        // Across the jaws.
        f.forward = leftOf(shark.forward) * shark.sense;
        f.worldFromBody = blended(f.worldFromBody, bodyTurn(f.forward, 0), 0.15f);
        f.speed = 0;
        f.gait.set(Motion::Struggle);
        f.gait.advance(1.2f);
        const float away = glm::length(glm::vec3(f.position.x, 0, f.position.z));
        if (away > kCarryTo_m || shark.mind == Shark::Mind::Circle) {
            // It wriggles free far out and comes back to its band.
            f.mind = Fish::Mind::Dart;
            f.dart_s = 1.0f;
            f.frightRest_s = 2;
            f.uncatchable_s = kUncatchable_s;
            f.flee = normalizedOr({-f.position.x, 0, -f.position.z}, f.forward);
            shark.mouth = -1;
        }
    }

    const bool striking = shark.mind == Shark::Mind::Strike;
    if (shark.gait.motion != Motion::Bite || shark.mind_s > 0.6f)
        shark.gait.set(striking ? Motion::Lunge : Motion::Cruise);
    shark.gait.advance(std::clamp(shark.speed / species[shark.species].cruise_mps, 0.6f, 2.0f));
}

} // namespace shoal::game
