#include "game/rules/SharkBehaviour.h"

#include "game/rules/Hand.h"
#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

using State = Shark::State;

namespace {

glm::vec3 mouthOf(const Shark& shark, const SpeciesTable& species) {
    return shark.mouthPosition(species[shark.species].length_m);
}

int idOf(const SharkView& view) { return static_cast<int>(view.fish.size()); }

// The hand that holds a fish, or else the one nearest to its mouth; -1 if there is none to be seen.
int watchedHand(const Shark& shark, const SharkView& view) {
    int best = -1;
    float minimum = 1e9f;
    for (int h = 0; h < 2; ++h) {
        const Hand& hand = view.hands[h];
        if (!hand.visible) continue;
        const float distance = glm::distance(mouthOf(shark, view.species), hand.graspCentre) -
                               (hand.grasp.holds >= 0 ? 10.0f : 0.0f);
        if (distance < minimum) minimum = distance, best = h;
    }
    return best;
}

// A fish that struggles in a hand, -1 if none does.
int strugglingFish(const SharkView& view) {
    int struggling = -1;
    for (const Hand& hand : view.hands) {
        const int held = hand.grasp.holds;
        if (held >= 0 && !view.fish[held].counted && view.fish[held].held_s > 0.12f) struggling = held;
    }
    return struggling;
}

void decideCircling(Shark& shark, const SharkView& view, Events& events) {
    const auto& visits = view.dive.shark.visits_s;
    const bool due = shark.nextVisit < visits.size() && view.time_s >= visits[shark.nextVisit];
    if (due) ++shark.nextVisit;
    if (view.diveIsOver || !(due || (shark.interest > kTempted && shark.state_s > 8))) return;
    shark.set(State::Prowl);
    shark.threatRest_s = 0;
    shark.visit_s = view.dive.shark.visitLength_s;
    shark.interest = 0;
    events.push_back({.kind = EventKind::SharkNear, .creature = idOf(view), .position = shark.position});
}

void decideProwling(Shark& shark, const SharkView& view, int struggling) {
    shark.visit_s -= kDt;
    shark.threatRest_s -= kDt;
    const int hand = watchedHand(shark, view);
    const float room =
        hand < 0 ? 0 : glm::distance(mouthOf(shark, view.species), view.hands[hand].graspCentre);
    const bool holds = struggling >= 0 && hand >= 0 && view.hands[hand].grasp.holds == struggling;
    if (shark.visit_s <= 0)
        shark.set(State::Leave);
    else if (hand >= 0 && room > 1.3f * kThreatRoom_m && room < kThreatFrom_m &&
             (holds || shark.threatRest_s <= 0)) {
        shark.set(State::Threaten);
        shark.watched = hand;
        shark.aimed_s = 0;
    }
}

void decideThreatening(Shark& shark, const SharkView& view, int struggling) {
    shark.visit_s -= kDt;
    const Hand& hand = view.hands[shark.watched];
    const glm::vec3 to = hand.graspCentre - shark.position;
    const bool aimed = glm::dot(shark.forward, normalizedOr(to, shark.forward)) > kAimed;
    shark.aimed_s = aimed ? shark.aimed_s + kDt : 0;
    const float room = glm::distance(mouthOf(shark, view.species), hand.graspCentre);
    const bool held = struggling >= 0 && hand.grasp.holds == struggling;
    if (held && shark.aimed_s >= kAim_s && room < kStrikeFrom_m) {
        shark.prey = struggling;
        shark.set(State::Strike);
    } else if (!hand.visible || room < kThreatRoom_m || shark.state_s > kThreat_s) {
        shark.threatRest_s = kThreatRest_s;
        shark.set(shark.visit_s > 0 ? State::Prowl : State::Leave);
    }
}

void decideStriking(Shark& shark, const SharkView& view) {
    const Fish& prey = view.fish[shark.prey];
    if (prey.state == Fish::State::Held && !prey.counted && shark.state_s <= kStrikeTime_s) return;
    shark.prey = -1;
    shark.set(shark.visit_s > 0 ? State::Prowl : State::Leave);
}

void decideLeaving(Shark& shark, const SharkView& view) {
    if (placeOf(shark.position).radius > view.dive.shark.radius_m - 0.6f || shark.state_s > 15)
        shark.set(State::Circle);
}

void steal(Shark& shark, Fish& f, int id, Hands& hands, Score& score, Events& events) {
    const int h = f.heldBy;
    hands[h].grasp.holds = -1;
    f.heldBy = -1;
    f.state = Fish::State::Mouth;
    shark.mouth = id;
    shark.prey = -1;
    ++score.lost;
    events.push_back({EventKind::SharkSteal, id, h, f.position});
    shark.set(State::Leave);
    shark.visit_s = 0;
    shark.gait.set(Motion::Bite);
}

// The fish in its mouth lies across the jaws.
void carryInMouth(const Shark& shark, glm::vec3 mouth, Fish& f) {
    const glm::vec3 was = f.position;
    const glm::vec3 at = mouth - 0.05f * kUp;
    f.position += (at - f.position) * 0.3f;
    f.velocity = (f.position - was) / kDt;
    f.forward = leftOf(shark.forward) * shark.sense;
    f.worldFromBody = blended(f.worldFromBody, bodyTurn(f.forward, 0), 0.15f);
    f.speed = 0;
    f.gait.set(Motion::Struggle);
    f.gait.advance(1.2f);
    f.shape.beats += 4 * kDt;
    f.shape.amplitude += (0.1f - f.shape.amplitude) * (5 * kDt);
}

// It wriggles free far out and comes back to its band.
void breakFree(Shark& shark, Fish& f) {
    f.state = Fish::State::Dart;
    f.dart_s = 1.0f;
    f.frightRest_s = 2;
    f.uncatchable_s = kUncatchable_s;
    f.flee = normalizedOr({-f.position.x, 0, -f.position.z}, f.forward);
    shark.mouth = -1;
}

} // namespace

void decide(Shark& shark, const SharkView& view, Events& events) {
    shark.bumpRest_s = std::max(0.0f, shark.bumpRest_s - kDt);
    shark.state_s += kDt;
    const int struggling = strugglingFish(view);
    shark.interest = struggling >= 0 ? shark.interest + kDt : std::max(0.0f, shark.interest - 0.03f * kDt);
    switch (shark.state) {
    case State::Circle:
        return decideCircling(shark, view, events);
    case State::Prowl:
        return decideProwling(shark, view, struggling);
    case State::Threaten:
        return decideThreatening(shark, view, struggling);
    case State::Strike:
        return decideStriking(shark, view);
    case State::Leave:
        return decideLeaving(shark, view);
    }
}

void bite(Shark& shark, const SpeciesTable& species, Hands& hands, std::span<Fish> fish, Score& score,
          Events& events) {
    const glm::vec3 mouth = mouthOf(shark, species);
    if (shark.state == State::Strike && glm::distance(mouth, fish[shark.prey].position) < kJaws_m)
        steal(shark, fish[shark.prey], shark.prey, hands, score, events);
    if (shark.mouth >= 0) {
        Fish& f = fish[shark.mouth];
        carryInMouth(shark, mouth, f);
        if (placeOf(f.position).radius > kCarryTo_m || shark.state == State::Circle) breakFree(shark, f);
    }
    if (shark.gait.motion != Motion::Bite || shark.state_s > 0.6f)
        shark.gait.set(shark.state == State::Strike ? Motion::Lunge : Motion::Cruise);
    shark.gait.advance(std::clamp(shark.speed / species[shark.species].cruise_mps, 0.6f, 2.0f));
}

void bumpHands(Shark& shark, const SpeciesTable& species, std::span<const physics::Contact> own, Hands& hands,
               std::span<Fish> fish, Events& events) {
    for (const physics::Contact& contact : own) {
        const int h = contact.group;
        if (shark.bumpRest_s > 0) return;
        const bool striking = shark.state == State::Strike && hands[h].grasp.holds == shark.prey;
        if (striking) continue; // its jaws come first; see bite()
        shark.bumpRest_s = 0.8f;
        shark.visit_s = std::min(shark.visit_s, 1.0f); // it has had enough
        events.push_back({EventKind::SharkBump, static_cast<int>(fish.size()), h, contact.point,
                          partOfBone(contact.tag), contact.closingSpeed});
        if (hands[h].grasp.holds >= 0) drop(hands[h], h, species, fish, events);
    }
}

} // namespace shoal::game
