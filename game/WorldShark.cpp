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

// It never strikes unannounced: first it points at a hand, slowly, in full view, for at least so long.
constexpr float kAim_s = 1.1f;
constexpr float kAimed = 0.92f;       // cosine of the angle within which it points at it
constexpr float kThreat_s = 4.5f;     // then it breaks off
constexpr float kThreatRest_s = 2.5f; // before the next
constexpr float kThreatFrom_m = 2.6f; // from its mouth to the hand
constexpr float kThreatRoom_m = 0.7f; // nearer than that it turns away
constexpr float kWide_m = 2.6f;       // radius from which it begins the next approach

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

// The hand that holds a fish, or else the one nearest to its mouth; -1 if there is none to be seen.
int World::watchedHand() const {
    int best = -1;
    float least = 1e9f;
    for (int h = 0; h < 2; ++h) {
        if (!hands[h].visible) continue;
        const float distance =
            glm::distance(mouthPosition(), hands[h].grasp) - (hands[h].holds >= 0 ? 10.0f : 0.0f);
        if (distance < least) least = distance, best = h;
    }
    return best;
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
        shark.threatRest_s = 0;
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
    case Mind::Prowl: {
        shark.visit_s -= kDt;
        shark.threatRest_s -= kDt;
        const int hand = watchedHand();
        const float room = hand < 0 ? 0 : glm::distance(mouthPosition(), hands[hand].grasp);
        const bool holds = struggling >= 0 && hand >= 0 && hands[hand].holds == struggling;
        if (shark.visit_s <= 0)
            setMind(Mind::Leave);
        else if (hand >= 0 && room > 1.3f * kThreatRoom_m && room < kThreatFrom_m &&
                 (holds || shark.threatRest_s <= 0)) {
            setMind(Mind::Threaten);
            shark.watched = hand;
            shark.aimed_s = 0;
        }
        break;
    }
    case Mind::Threaten: {
        shark.visit_s -= kDt;
        const Hand& hand = hands[shark.watched];
        const glm::vec3 to = hand.grasp - shark.position;
        const bool aimed = glm::dot(shark.forward, normalizedOr(to, shark.forward)) > kAimed;
        shark.aimed_s = aimed ? shark.aimed_s + kDt : 0;
        const float room = glm::distance(mouthPosition(), hand.grasp);
        const bool held = struggling >= 0 && hand.holds == struggling;
        if (held && shark.aimed_s >= kAim_s && room < kStrikeFrom_m) {
            shark.prey = struggling;
            setMind(Mind::Strike);
        } else if (!hand.visible || room < kThreatRoom_m || shark.mind_s > kThreat_s) {
            shark.threatRest_s = kThreatRest_s;
            setMind(shark.visit_s > 0 ? Mind::Prowl : Mind::Leave);
        }
        break;
    }
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

    // A visit is a row of approaches: close past the player, wide out, and in again.
    const bool visits = shark.mind == Mind::Prowl;
    const bool wide = shark.threatRest_s > 0 && shark.threatRest_s < 0.6f * kThreatRest_s;
    const float circle = visits ? (wide ? kWide_m : file.shark.prowlRadius_m) : file.shark.radius_m;
    const float height = visits ? 0.5f * file.shark.height_m : file.shark.height_m;
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
    case Mind::Threaten: {
        desired = hands[shark.watched].grasp - shark.position;
        goalSpeed = 0.4f * kind.cruise_mps;
        turn = 1.8f;
        break;
    }
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
    const bool after = shark.mind == Mind::Strike || shark.mind == Mind::Threaten;
    if (noseRoom < 1.1f && !after) {
        desired += nose / std::max(noseRoom, 0.05f) * (2.5f * (1.1f - noseRoom));
        if (glm::dot(shark.forward, nose) < 0) goalSpeed = std::min(goalSpeed, 0.5f * kind.cruise_mps);
    }

    const glm::vec3 goal = levelled(normalizedOr(desired, shark.forward), 0.35f);
    const bool strikes = shark.mind == Mind::Strike;
    const glm::vec3 spin = turnSmoothly(shark.forward, shark.spin, goal, strikes ? 8.0f : 2.5f * turn, turn,
                                        strikes ? 40.0f : 8.0f * turn, kDt);
    shark.forward = levelled(shark.forward, 0.4f);
    const float yawRate = glm::dot(shark.spin, kUp);
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
    sharkBendAndBeat(spin);
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
        f.shape.beats += 4 * kDt;
        f.shape.amplitude += (0.1f - f.shape.amplitude) * (5 * kDt);
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
