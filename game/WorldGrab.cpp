// Closing a hand on a fish, holding it, letting it go.
#include "game/Steering.h"
#include "game/World.h"

#include <limits>

namespace shoal::game {

namespace {

constexpr float kSlip_mps = 6; // a fish slips out of a hand faster than this

} // namespace

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
            if (hand.holds >= 0 && hand.untrackedTicks > kHandDropTicks)
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
