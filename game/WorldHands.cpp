// What the player's hands are this tick, and what they do to fish.
#include "game/Steering.h"
#include "game/World.h"

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

// Finger, or the palm, that the bone from kJointParent[joint] to the joint belongs to. The bones of the back
// of the hand are the palm's.
int partOfBone(int joint) {
    if (joint < 2) return haptics::kPalm;
    if (joint < 6) return joint == 2 ? haptics::kPalm : 0;
    const int inFinger = (joint - 6) % 5;
    return inFinger <= 1 ? haptics::kPalm : 1 + (joint - 6) / 5;
}

physics::Capsule bone(const std::array<hands::Joint, hands::kJointCount>& joints, int joint) {
    const hands::Joint& from = joints[hands::kJointParent[joint]];
    const hands::Joint& to = joints[joint];
    return {from.position, to.position, std::min(from.radius, to.radius)};
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
        if (!hand.visible) {
            hand.untrackedTicks = std::min(hand.untrackedTicks, 10 * kHandDropTicks);
            hand.velocity = hand.calmVelocity = glm::vec3(0);
            hand.window = 0;
            continue;
        }
        if (!appears) hand.before = hand.joints;
        for (int j = 0; j < hands::kJointCount; ++j) {
            hand.joints[j] = hand.lastGood.joints[j];
            hand.joints[j].position = headWorld + worldFromView * hand.joints[j].position;
            hand.joints[j].orientation = worldFromView * hand.joints[j].orientation;
        }
        if (appears) hand.before = hand.joints;
        hand.velocity = (hand.joints[0].position - hand.before[0].position) / kDt;
        hand.calmVelocity += (hand.velocity - hand.calmVelocity) * (1.0f / 6);
        if (appears) hand.calmVelocity = glm::vec3(0);
        hand.grasp = hands::graspCentre(hand.joints);
        hand.grip = std::clamp(hand.lastGood.grip, 0.0f, 1.0f);
        if (appears)
            hand.closed =
                hand.holds >= 0 || hand.grip > kGripCloses; // a fist that appears did not close here
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
        if (!hand.visible) continue;
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
        if (!hands[h].visible) continue;
        for (int j = 2; j < hands::kJointCount; ++j)
            movers.push_back({bone(hands[h].before, j), bone(hands[h].joints, j), h, j});
    }
    bodies.clear();
    const auto near = [&](glm::vec3 position, float bound) {
        for (const Hand& hand : hands) {
            if (!hand.visible) continue;
            const glm::vec3 a = hand.before[0].position, b = hand.joints[0].position;
            if (physics::separation({a, b, 0.25f}, {position, position, bound}) < 0) return true;
        }
        return false;
    };
    for (size_t i = 0; i < fish.size(); ++i) {
        const Fish& f = fish[i];
        const Species& kind = species[f.species];
        if (f.mind == Fish::Mind::Held || f.mind == Fish::Mind::Mouth) continue;
        if (!near(f.position, kind.bodyHalf_m + kind.bodyRadius_m)) continue;
        bodies.push_back({static_cast<uint32_t>(i), f.position, f.forward, f.velocity, kind.bodyRadius_m,
                          kind.bodyHalf_m});
    }
    if (shark.present) {
        const Species& kind = species[shark.species];
        if (near(shark.position, kind.bodyHalf_m + kind.bodyRadius_m))
            bodies.push_back({static_cast<uint32_t>(sharkId()), shark.position, shark.forward, shark.velocity,
                              kind.bodyRadius_m, kind.bodyHalf_m});
    }
    contactWorld.collide(bodies, movers, kDt, contacts);

    int touchedBefore = -1;
    for (const physics::Contact& contact : contacts) {
        const int id = static_cast<int>(contact.body), h = contact.group;
        const int part = partOfBone(contact.tag);
        Hand& hand = hands[h];
        if (id == sharkId()) {
            if (shark.bumpRest_s > 0) continue;
            const bool striking = shark.mind == Shark::Mind::Strike && hand.holds == shark.prey;
            if (striking) continue; // its jaws come first; see swimShark
            shark.bumpRest_s = 0.8f;
            shark.visit_s = std::min(shark.visit_s, 1.0f); // it has had enough
            emit(out, Event::Kind::SharkBump, id, h, part, contact.closingSpeed, contact.point);
            if (hand.holds >= 0)
                letGo(h, fish[hand.holds].counted ? Event::Kind::Release : Event::Kind::Escape, out);
            continue;
        }
        Fish& f = fish[id];
        if (f.uncatchable_s > kUncatchable_s - 0.5f)
            continue; // just let go: it slides out between the fingers
        if (tick > f.touchedUntil[h][part])
            emit(out, Event::Kind::Touch, id, h, part, contact.closingSpeed, contact.point);
        f.touchedUntil[h][part] = tick + kTouchKept;

        // An open hand lets it in between thumb and fingers, and closing fingers hold it: neither bats it
        // away.
        const bool beingGrasped =
            graspGap(f, hand) < 1.5f * kGraspRadius_m && onPalmSide(f, hand) && !hand.closed;
        const float palmClosing = glm::dot(hand.velocity - f.velocity, contact.normal);
        if (!beingGrasped) {
            const float shove = std::min(0.6f * contact.closingSpeed + 0.04f, kMaxSpeed_mps);
            const float already = glm::dot(f.push, contact.normal);
            f.push += contact.normal * std::max(0.0f, shove - already);
        }
        if (id != touchedBefore) f.nervous_s += kDt; // contacts come sorted by body
        touchedBefore = id;
        if (palmClosing > kGentle_mps || f.nervous_s > kPatience_s || (hand.closed && hand.window == 0))
            startle(id, hand.joints[0].position, out);
    }
    for (Fish& f : fish) f.nervous_s = std::max(0.0f, f.nervous_s - 0.1f * kDt);
}

} // namespace shoal::game
