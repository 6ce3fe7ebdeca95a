// What the player's hands are this tick, and what they do to fish.
#include "game/Bones.h"
#include "game/Steering.h"
#include "game/World.h"

#include "engine/physics/Push.h"
#include "input/hands/HandRig.h"

namespace shoal::game {

namespace {

constexpr int kKeepTicks = 12;      // a hand lost for less than 0.1 s stays where it was
constexpr uint32_t kTouchKept = 12; // ticks a touch is remembered
constexpr float kGentle_mps = 0.5f; // a palm slower than this does not frighten by touching...
constexpr float kPatience_s = 0.5f; // ...for so long

bool sound(const glm::quat& q) {
    const float norm = glm::dot(q, q);
    return norm > 0.9f && norm < 1.1f; // false for NaN
}

// It does not move as far as fish are concerned, and takes hold of nothing.
void rest(Hand& hand) {
    hand.velocity = hand.calmVelocity = hand.calmAcceleration = glm::vec3(0);
    hand.velocities.fill(glm::vec3(0));
    hand.window = 0;
}

} // namespace

void World::readHands(const TickInput& input) {
    if (sound(input.worldFromView)) worldFromView = glm::normalize(input.worldFromView);
    if (glm::dot(input.headWorld, input.headWorld) <= kHeadReach_m * kHeadReach_m)
        headWorld = input.headWorld;
    for (int i = 0; i < 2; ++i) {
        Hand& hand = hands[i];
        const hands::HandPose& given = input.hands[i];
        if (given.tracked) {
            // A pose that cannot be is not believed: the last good one stays.
            if (hands::plausible(given)) {
                hand.lastGood = given;
                hand.known = true;
                hand.untrackedTicks = 0;
            } else
                ++hand.untrackedTicks;
        } else
            ++hand.untrackedTicks;
        const bool appears = !hand.visible;
        hand.visible = hand.known && hand.untrackedTicks <= kKeepTicks;
        hand.solid = hand.visible && hand.lastGood.solid;
        hand.touching = {};
        hand.pressCount = 0;
        if (!hand.visible) {
            hand.untrackedTicks = std::min(hand.untrackedTicks, 10 * kHandDropTicks);
            rest(hand);
            continue;
        }
        if (!appears) hand.before = hand.joints;
        for (int j = 0; j < hands::kJointCount; ++j) {
            hand.joints[j] = hand.lastGood.joints[j];
            hand.joints[j].position = headWorld + worldFromView * hand.joints[j].position;
            hand.joints[j].orientation = worldFromView * hand.joints[j].orientation;
        }
        hand.shown = hand.joints;
        hand.grasp = hands::graspCentre(hand.joints);
        hand.grip = std::clamp(hand.lastGood.grip, 0.0f, 1.0f);
        if (appears) {
            hand.closed =
                hand.holds >= 0 || hand.grip > kGripCloses; // a fist that appears did not close here
            hand.firmest = std::max(hand.grip, kGripOpens);
        }
        const bool replaced =
            glm::distance(hand.joints[0].position, hand.before[0].position) > physics::kTeleport_m;
        if (appears || replaced || !hand.solid) {
            hand.before = hand.joints;
            rest(hand);
            continue;
        }
        hand.velocity = (hand.joints[0].position - hand.before[0].position) / kDt;
        const glm::vec3 calmer = (hand.velocity - hand.calmVelocity) * (1.0f / 6);
        hand.calmVelocity += calmer;
        hand.calmAcceleration += (calmer / kDt - hand.calmAcceleration) * (1.0f / 6);
        for (int j = 0; j < hands::kJointCount; ++j) {
            const glm::vec3 now = (hand.joints[j].position - hand.before[j].position) / kDt;
            hand.velocities[j] += (now - hand.velocities[j]) * (1.0f / 3);
        }
    }
}

void World::startle(int index, glm::vec3 from, std::vector<Event>& out) {
    Fish& f = fish[index];
    if (f.mind == Fish::Mind::Held || f.mind == Fish::Mind::Mouth) return;
    // Away from the danger, rather along than up or down, and not through the player.
    glm::vec3 away = normalizedOr(f.position - from, f.forward);
    const glm::vec3 outward = normalizedOr({f.position.x, 0, f.position.z}, {0, 0, -1});
    away =
        normalizedOr(glm::vec3(away.x, 0.4f * away.y, away.z) + outward * 0.5f + f.forward * 0.3f, f.forward);
    f.flee = away;
    f.dart_s = 0.8f + 0.5f * random.unit();
    f.nervous_s = 0;
    if (f.frightRest_s > 0) return;
    f.mind = Fish::Mind::Dart;
    f.frightRest_s = 1.5f;
    emit(out, Event::Kind::Startle, index, -1, -1, glm::length(f.velocity), f.position);
}

void World::frightenByHands(std::vector<Event>& out) {
    for (const Hand& hand : hands) {
        if (!hand.solid) continue;
        for (size_t i = 0; i < fish.size(); ++i) {
            const Fish& f = fish[i];
            if (f.mind != Fish::Mind::Cruise || f.frightRest_s > 0) continue;
            const float shyness = species[f.species].shyness;
            const glm::vec3 apart = f.position - hand.grasp;
            const float distance = glm::length(apart);
            if (distance > 0.8f || distance < 1e-4f) continue;
            // A hand coming on at 1.2 m/s is noticed at 0.23 m, at 3 m/s at 0.5 m.
            const float closing = glm::dot(hand.calmVelocity - f.velocity, apart / distance);
            if (closing < 1.2f || distance > shyness * (0.05f + 0.15f * closing)) continue;
            startle(static_cast<int>(i), hand.grasp, out);
        }
    }
}

void World::touch(std::vector<Event>& out) {
    movers.clear();
    for (int h = 0; h < 2; ++h) {
        const Hand& hand = hands[h];
        if (!hand.solid) continue;
        const float give = hand.closed ? 1.0f : physics::kGive; // fingers of an open hand give way
        for (int j = 2; j < hands::kJointCount; ++j)
            movers.push_back({bone(hand.before, j), bone(hand.joints, j),
                              give * hand.velocities[hands::kJointParent[j]], give * hand.velocities[j], h,
                              j});
    }
    bodies.clear();
    const auto add = [&](int id, const auto& creature) {
        const Species& kind = species[creature.species];
        const auto near = [&](const Hand& hand) {
            if (!hand.solid) return false;
            const glm::vec3 a = hand.before[0].position, b = hand.joints[0].position;
            return physics::separation({a, b, 0.25f}, {creature.position, creature.position,
                                                       kind.bodyHalf_m + kind.bodyRadius_m}) < 0;
        };
        if (!near(hands[0]) && !near(hands[1])) return;
        const glm::vec3 reach = creature.forward * kind.bodyHalf_m, way = creature.velocity * kDt;
        const glm::vec3 nose = creature.position + reach, tail = creature.position - reach;
        bodies.push_back({static_cast<uint32_t>(id),
                          {tail - way, nose - way, kind.bodyRadius_m},
                          {tail, nose, kind.bodyRadius_m},
                          creature.velocity});
    };
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        f.parting = glm::vec3(0);
        if (f.mind == Fish::Mind::Mouth || (f.heldBy >= 0 && !hands[f.heldBy].solid)) continue;
        f.loose_s = std::max(0.0f, f.loose_s - kDt);
        if (f.loose_s > 0) continue;
        add(static_cast<int>(i), f);
    }
    if (shark.present) add(sharkId(), shark);
    std::swap(contacts, lastContacts);
    contactWorld.collide(bodies, movers, kDt, lastContacts, contacts);

    for (auto from = contacts.begin(); from != contacts.end();) {
        const auto to =
            std::find_if(from, contacts.end(), [&](const auto& c) { return c.body != from->body; });
        const std::span<const physics::Contact> own(from, to);
        if (static_cast<int>(from->body) == sharkId())
            bump(own, out);
        else {
            for (const physics::Contact& contact : own) feel(contact);
            if (fish[from->body].heldBy < 0) pushFish(own, out);
        }
        from = to;
    }
    for (Fish& f : fish) f.nervous_s = std::max(0.0f, f.nervous_s - 0.1f * kDt);
}

void World::bump(std::span<const physics::Contact> own, std::vector<Event>& out) {
    for (const physics::Contact& contact : own) {
        const int h = contact.group;
        if (shark.bumpRest_s > 0) return;
        const bool striking = shark.mind == Shark::Mind::Strike && hands[h].holds == shark.prey;
        if (striking) continue; // its jaws come first; see swimShark
        shark.bumpRest_s = 0.8f;
        shark.visit_s = std::min(shark.visit_s, 1.0f); // it has had enough
        emit(out, Event::Kind::SharkBump, sharkId(), h, partOfBone(contact.tag), contact.closingSpeed,
             contact.point);
        if (hands[h].holds >= 0) drop(h, out);
    }
}

void World::feel(const physics::Contact& contact) {
    const Fish& f = fish[contact.body];
    const glm::vec3 relative = contact.moverVelocity - f.velocity;
    const float along = glm::dot(relative, contact.normal);
    TouchView& under = hands[contact.group].touching[partOfBone(contact.tag)];
    under.touches = true;
    if (hands[contact.group].encloses != static_cast<int>(contact.body))
        under.depth_m = std::max(under.depth_m, contact.depth);
    under.press_mps = std::max(under.press_mps, along);
    under.slide_mps = std::max(under.slide_mps, glm::length(relative - along * contact.normal));
    if (f.heldBy == contact.group) under.struggle = f.struggle;
}

void World::pushFish(std::span<const physics::Contact> own, std::vector<Event>& out) {
    const int id = static_cast<int>(own.front().body);
    Fish& f = fish[id];
    f.nervous_s += kDt;
    for (const physics::Contact& contact : own) {
        const int h = contact.group, part = partOfBone(contact.tag);
        if (tick > f.touchedUntil[h][part])
            emit(out, Event::Kind::Touch, id, h, part, contact.closingSpeed, contact.point);
        f.touchedUntil[h][part] = tick + kTouchKept;
        const Hand& hand = hands[h];
        const float palmClosing = glm::dot(hand.velocity - f.velocity, contact.normal);
        if (palmClosing > kGentle_mps || f.nervous_s > kPatience_s || (hand.closed && hand.window == 0))
            startle(id, hand.joints[0].position, out);
    }
    // Fingers that close around it hold it and do not bat it away; neither does an open hand that it swims
    // into: a player's fingers would give way.
    const auto bats = [&](int h) {
        const Hand& hand = hands[h];
        const bool lets = !hand.closed && onPalmSide(f, hand) && graspGap(f, hand) < 1.5f * kGraspRadius_m;
        return hand.encloses != id && !lets;
    };
    const std::array<bool, 2> hits = {bats(0), bats(1)};
    const auto from = std::find_if(own.begin(), own.end(), [&](const auto& c) { return hits[c.group]; });
    const auto to = std::find_if(from, own.end(), [&](const auto& c) { return !hits[c.group]; });
    const std::span<const physics::Contact> pushing(from, to);
    const glm::vec3 kept = f.forward * f.speed + f.push; // without the parting, which leaves no speed
    f.push = limited(f.push + physics::pushed(kept, pushing) - kept, kMaxSpeed_mps);
    f.parting = physics::parting(pushing);
}

} // namespace shoal::game
