// Closing a hand on a fish, holding it, letting it go.
#include "game/Bones.h"
#include "game/Steering.h"
#include "game/World.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace shoal::game {

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

void World::drawIn(Fish& f, const Hand& hand) const {
    const glm::vec3 wanted =
        hand.calmVelocity +
        limited((hollowOf(hand.joints[0], std::min(species[f.species].bodyRadius_m, physics::kEnclosed_m)) -
                 f.position) *
                    physics::kDrawRate_Hz,
                physics::kDrawMost_mps);
    f.push = limited(wanted, kMaxSpeed_mps) - f.forward * f.speed;
}

void World::drop(int h, std::vector<Event>& out) {
    letGo(h, fish[hands[h].holds].counted ? Event::Kind::Release : Event::Kind::Escape, out);
}

void World::closeHands(std::vector<Event>& out) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (!hand.visible) {
            if (hand.holds >= 0 && hand.untrackedTicks > kHandDropTicks) drop(h, out);
            continue;
        }
        if (!hand.solid) continue;
        if (hand.grip < kGripOpens) {
            hand.closed = false;
            hand.firmest = kGripOpens;
            hand.window = 0;
        } else if (hand.grip > hand.firmest + physics::kFirmer) {
            hand.firmest = hand.grip;
            hand.window = kCloseWindow;
        }
        hand.closed = hand.closed || hand.grip > kGripCloses;
        if (hand.holds >= 0) enclose(hand.holds, hand);
        hand.encloses = hand.holds;
        if (hand.window == 0 || hand.holds >= 0 || phase != Phase::Diving) continue;

        int nearest = -1;
        float gap = std::numeric_limits<float>::max();
        for (size_t i = 0; i < fish.size(); ++i) {
            if (!graspable(fish[i], hand, h)) continue;
            const float distance = graspGap(fish[i], hand);
            if (distance < gap) gap = distance, nearest = static_cast<int>(i);
        }
        if (nearest >= 0) {
            enclose(nearest, hand);
            hand.encloses = nearest;
            if (holdOn(nearest, glm::vec3(0)).margin_N > physics::kFirm_N) {
                grab(nearest, h, out);
                continue;
            }
            drawIn(fish[nearest], hand);
        }
        if (--hand.window == 0 && hand.closed) emit(out, Event::Kind::Miss, -1, h, -1, 0, hand.grasp);
    }
    takeBetweenHands(out);
}

void World::takeBetweenHands(std::vector<Event>& out) {
    if (phase != Phase::Diving || hands[0].holds >= 0 || hands[1].holds >= 0) return;
    for (auto from = contacts.begin(); from != contacts.end();) {
        const auto to =
            std::find_if(from, contacts.end(), [&](const auto& c) { return c.body != from->body; });
        const int id = static_cast<int>(from->body);
        const bool both = from->group != std::prev(to)->group;
        from = to;
        if (!both || id == sharkId() || fish[id].heldBy >= 0 || fish[id].uncatchable_s > 0) continue;
        if (holdOn(id, glm::vec3(0)).margin_N < physics::kFirm_N) continue;
        const int h = graspGap(fish[id], hands[0]) < graspGap(fish[id], hands[1]) ? 0 : 1;
        grab(id, h, out);
        return;
    }
}

void World::grab(int index, int h, std::vector<Event>& out) {
    Fish& f = fish[index];
    Hand& hand = hands[h];
    hand.holds = hand.encloses = index;
    hand.window = 0;
    hand.firmest = 1; // it takes hold anew only after it has opened
    f.mind = Fish::Mind::Held;
    f.heldBy = h;
    f.held_s = 0;
    f.counted = false;
    f.push = f.slide = glm::vec3(0);
    f.slid_m = 0;
    f.unopposed = 0;
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
    hand.holds = hand.encloses = -1;
    Fish& f = fish[index];
    f.struggle = 0;
    f.loose_s = physics::kLoose_s;
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

} // namespace shoal::game
