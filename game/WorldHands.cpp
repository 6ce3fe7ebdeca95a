// What the player's hands are this tick, and what they do to fish.
#include "game/Steering.h"
#include "game/World.h"

#include "input/hands/HandRig.h"

#include <limits>

namespace shoal::game {

namespace {

constexpr int kKeepTicks = 12;      // a hand lost for less than 0.1 s stays where it was
constexpr int kDropTicks = 36;      // lost for longer: what it holds swims off
constexpr float kSlip_mps = 6;      // a fish slips out of a hand faster than this
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
            hand.untrackedTicks = std::min(hand.untrackedTicks, 10 * kDropTicks);
            hand.velocity = hand.calmVelocity = glm::vec3(0);
            hand.window = 0;
            continue;
        }
        if (!appears) hand.before = hand.joints;
        for (int j = 0; j < hands::kJointCount; ++j) {
            hand.joints[j] = hand.lastGood.joints[j];
            hand.joints[j].position = worldFromView * hand.joints[j].position;
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

float World::graspGap(const Fish& f, const Hand& hand) const {
    const Species& kind = species[f.species];
    const glm::vec3 reach = f.forward * kind.bodyHalf_m;
    return physics::separation({hand.grasp, hand.grasp, 0},
                               {f.position - reach, f.position + reach, kind.bodyRadius_m});
}

bool World::onPalmSide(const Fish& f, const Hand& hand) const {
    const glm::vec3 outOfPalm = hand.joints[0].orientation * glm::vec3(0, -1, 0);
    return glm::dot(f.position - hand.joints[0].position, outOfPalm) > 0;
}

bool World::graspable(const Fish& f, const Hand& hand, int h) const {
    if (f.mind == Fish::Mind::Held || f.mind == Fish::Mind::Mouth || f.uncatchable_s > 0) return false;
    if (!onPalmSide(f, hand)) return false;
    if (graspGap(f, hand) < kGraspRadius_m) return true;
    const auto touched = [&](int part) { return f.touchedUntil[h][part] > tick; };
    return (touched(0) || touched(haptics::kPalm)) &&
           (touched(1) || touched(2) || touched(3) || touched(4)) && graspGap(f, hand) < 2 * kGraspRadius_m;
}

void World::closeHands(std::vector<Event>& out) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (!hand.visible) {
            if (hand.holds >= 0 && hand.untrackedTicks > kDropTicks)
                letGo(h, fish[hand.holds].counted ? Event::Kind::Release : Event::Kind::Escape, out);
            continue;
        }
        if (hand.closed && hand.grip < kGripOpens) {
            hand.closed = false;
            hand.window = 0;
            if (hand.holds >= 0)
                letGo(h, fish[hand.holds].counted ? Event::Kind::Release : Event::Kind::Escape, out);
        } else if (!hand.closed && hand.grip > kGripCloses) {
            hand.closed = true;
            hand.window = kCloseWindow;
        }
        if (hand.holds >= 0 && glm::length(hand.velocity) > kSlip_mps)
            letGo(h, fish[hand.holds].counted ? Event::Kind::Release : Event::Kind::Escape, out);
        if (hand.window == 0 || hand.holds >= 0 || phase != Phase::Diving) continue;

        int nearest = -1;
        float gap = std::numeric_limits<float>::max();
        for (size_t i = 0; i < fish.size(); ++i) {
            if (!graspable(fish[i], hand, h)) continue;
            const float distance = graspGap(fish[i], hand);
            if (distance < gap) gap = distance, nearest = static_cast<int>(i);
        }
        if (nearest >= 0)
            grab(nearest, h, out);
        else if (--hand.window == 0)
            emit(out, Event::Kind::Miss, -1, h, -1, 0, hand.grasp);
    }
}

void World::grab(int index, int h, std::vector<Event>& out) {
    Fish& f = fish[index];
    Hand& hand = hands[h];
    hand.holds = index;
    hand.window = 0;
    f.mind = Fish::Mind::Held;
    f.heldBy = h;
    f.held_s = 0;
    f.counted = false;
    f.push = glm::vec3(0);
    f.gait.set(Motion::Struggle);
    const glm::quat palmFromWorld = glm::conjugate(hand.joints[0].orientation);
    f.palmFromBody = palmFromWorld * f.worldFromBody;
    f.palmOffset = palmFromWorld * (f.position - hand.grasp);
    // In a fist a fish lies across the palm, head out at the side it was heading for, back towards wrist or
    // fingers.
    const glm::vec3 heading = f.palmFromBody * glm::vec3(0, 0, 1), back = f.palmFromBody * kUp;
    const glm::vec3 z(heading.x < 0 ? -1.0f : 1.0f, 0, 0), y(0, 0, back.z < 0 ? -1.0f : 1.0f);
    f.palmFromBodyGoal = glm::quat_cast(glm::mat3(glm::cross(y, z), y, z));
    emit(out, Event::Kind::Grab, index, h, -1, glm::length(hand.velocity - f.velocity), f.position);
}

void World::letGo(int h, Event::Kind why, std::vector<Event>& out) {
    Hand& hand = hands[h];
    const int index = hand.holds;
    hand.holds = -1;
    Fish& f = fish[index];
    f.heldBy = -1;
    f.mind = Fish::Mind::Dart;
    f.dart_s = 1.2f;
    f.frightRest_s = 1.5f;
    f.uncatchable_s = why == Event::Kind::Release ? kUncatchable_s : 0.6f;
    // Out of the hand, away from the player, the way it looks if that will do.
    const glm::vec3 outward = normalizedOr(f.position - 0.2f * kUp, {0, 0, -1});
    const glm::vec3 looks = f.worldFromBody * glm::vec3(0, 0, 1);
    f.flee = normalizedOr(glm::vec3(outward.x, 0.2f * outward.y, outward.z) * 0.7f + looks * 0.5f, outward);
    f.forward = levelled(normalizedOr(looks, f.flee), 0.6f);
    f.speed = std::min(0.5f, species[f.species].dart_mps);
    f.push = limited(0.3f * hand.calmVelocity, 0.6f);
    f.velocity = f.forward * f.speed + f.push;
    emit(out, why, index, h, -1, f.held_s, f.position);
}

void World::carry(std::vector<Event>& out) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (hand.holds < 0) continue;
        Fish& f = fish[hand.holds];
        f.held_s += kDt;
        const float settle = std::min(1.0f, f.held_s / 0.15f);
        // The wriggle: a beat of 4 Hz, strongest at first.
        const float wild = 0.3f * std::max(0.25f, 1 - 0.5f * f.held_s);
        const float beat = std::sin(f.held_s * 25.0f) * wild;
        const glm::quat wriggle(1, 0, 0.5f * beat, 0.2f * beat);
        const glm::quat palm = hand.joints[0].orientation;
        const glm::vec3 was = f.position;
        f.worldFromBody =
            glm::normalize(palm * blended(f.palmFromBody, f.palmFromBodyGoal, settle) * wriggle);
        f.position =
            hand.grasp + palm * (f.palmOffset * (1 - settle) + glm::vec3(0.012f * beat, 0, 0.02f * beat));
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        f.velocity = (f.position - was) / kDt;
        f.bank = 0;
        f.speed = 0;
        f.gait.set(Motion::Struggle);
        f.gait.advance(1.6f);
        if (!f.counted && f.held_s >= kHoldToCatch_s + 0.5f * kDt) {
            f.counted = true;
            ++caught;
            score += species[f.species].points;
            emit(out, Event::Kind::Catch, hand.holds, h, -1, 1, f.position);
        }
        if (f.counted && f.held_s >= kHoldToCatch_s + kShowCatch_s) letGo(h, Event::Kind::Release, out);
    }
}

} // namespace shoal::game
