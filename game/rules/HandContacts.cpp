#include "game/rules/HandContacts.h"

#include "game/rules/FishBehaviour.h"
#include "game/rules/Intent.h"

#include <algorithm>

namespace shoal::game {

namespace {

constexpr uint32_t kTouchKept = 12; // ticks for which a touch is remembered
constexpr float kGentle_mps = 0.6f; // speed of a palm below which its touch does not frighten...
constexpr float kPatience_s = 1.5f; // ...for this time

} // namespace

void HandContacts::collide(std::span<Fish> fish, const DiveContext& in,
                           std::vector<physics::Contact>& contacts) {
    const Hands& hands = in.state.hands;
    const Shark& shark = in.state.shark;
    const size_t maxBodies = fish.size() + 1, maxMovers = 2 * hands::kJointCount;
    bodies_.reserve(maxBodies);
    movers_.reserve(maxMovers);
    for (auto* found : {&contacts, &last_}) found->reserve(maxBodies * maxMovers);
    movers_.clear();
    for (int h = 0; h < 2; ++h) {
        const Hand& hand = hands[h];
        if (!hand.solid) continue;
        const float give = hand.grasp.closed ? 1.0f : physics::kGive; // fingers of an open hand give way
        for (int j = hands::kWristJoint + 1; j < hands::kJointCount; ++j)
            movers_.push_back({bone(hand.before, j), bone(hand.joints, j),
                               give * hand.velocities[hands::kJointParent[j]], give * hand.velocities[j], h,
                               j});
    }
    bodies_.clear();
    // Adds the swimmer's body if a solid hand's path in this tick comes near it.
    const auto addBody = [&](const Swimmer& swimmer, size_t id, const Species& kind) {
        const auto near = [&](const Hand& hand) {
            const glm::vec3 a = hand.before[hands::kPalmJoint].position, b = hand.palm().position;
            const float reach_m = kind.bodyHalf_m + kind.bodyRadius_m;
            return hand.solid &&
                   physics::separation({a, b, 0.25f}, {swimmer.position, swimmer.position, reach_m}) < 0;
        };
        if (!near(hands[0]) && !near(hands[1])) return;
        const glm::vec3 reach = swimmer.forward * kind.bodyHalf_m, way = swimmer.velocity * kDt;
        const glm::vec3 nose = swimmer.position + reach, tail = swimmer.position - reach;
        bodies_.push_back({static_cast<uint32_t>(id),
                           {tail - way, nose - way, kind.bodyRadius_m},
                           {tail, nose, kind.bodyRadius_m},
                           swimmer.velocity});
    };
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        f.separation = glm::vec3(0);
        if (f.state == Fish::State::Mouth || (f.heldBy >= 0 && !hands[f.heldBy].solid)) continue;
        f.hold.noPush_s = std::max(0.0f, f.hold.noPush_s - kDt);
        if (f.hold.noPush_s > 0) continue;
        addBody(f, i, in.kindOf(f));
    }
    if (shark.present) addBody(shark, fish.size(), in.kindOf(shark));
    std::swap(contacts, last_);
    physics::collide(bodies_, movers_, kDt, last_, contacts);
}

void feel(const physics::Contact& contact, const Fish& f, Hands& hands) {
    Hand& hand = hands[contact.group];
    const glm::vec3 relative = contact.moverVelocity - f.velocity;
    const float along = glm::dot(relative, contact.normal);
    TouchView& under = hand.touching[partOfBone(contact.tag)];
    under.touches = true;
    if (hand.grasp.encloses != static_cast<int>(contact.body))
        under.depth_m = std::max(under.depth_m, contact.depth);
    under.press_mps = std::max(under.press_mps, along);
    under.slide_mps = std::max(under.slide_mps, glm::length(relative - along * contact.normal));
    if (f.heldBy == contact.group) under.struggle = f.hold.struggle;
}

void pushFish(Fish& f, int id, std::span<const physics::Contact> own, const DiveContext& in, Random& random,
              Events& events) {
    f.flight.touchedGently_s += kDt;
    for (const physics::Contact& contact : own) {
        const int h = contact.group, part = partOfBone(contact.tag);
        if (in.state.tick > f.touchedUntil[h][part])
            events.push_back({EventKind::Touch, id, h, contact.point, part, contact.closingSpeed});
        f.touchedUntil[h][part] = in.state.tick + kTouchKept;
        const Hand& hand = in.state.hands[h];
        const float palmClosing = glm::dot(hand.calmVelocity - f.velocity, contact.normal);
        if (helpedTo(hand, id)) continue;
        if (palmClosing > kGentle_mps || f.flight.touchedGently_s > kPatience_s ||
            (hand.grasp.closed && hand.grasp.window == 0))
            startle(f, id, hand.palm().position, in, random, events);
    }
    // Fingers that close around the fish do not push it away. Neither does an open hand that it swims into,
    // because a player's fingers would give way.
    const auto bats = [&](int h) {
        const Hand& hand = in.state.hands[h];
        const bool lets = !hand.grasp.closed && onPalmSide(f, hand) &&
                          graspGap(f, in.kindOf(f), hand) < 1.5f * kGraspRadius_m;
        return hand.grasp.encloses != id && !helpedTo(hand, id) && !lets;
    };
    const std::array<bool, 2> hits = {bats(0), bats(1)};
    const auto from = std::find_if(own.begin(), own.end(), [&](const auto& c) { return hits[c.group]; });
    const auto to = std::find_if(from, own.end(), [&](const auto& c) { return !hits[c.group]; });
    const std::span<const physics::Contact> pushing(from, to);
    const glm::vec3 kept = f.forward * f.speed + f.push; // without the separation, which leaves no speed
    f.push = limited(f.push + physics::pushed(kept, pushing) - kept, kMaxSpeed_mps);
    f.separation = physics::separating(pushing);
}

} // namespace shoal::game
