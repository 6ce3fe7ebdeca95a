// What a hand does to the fish in it: fingers wrap around it, press, hold it, or let it slip.
#include "engine/physics/Finger.h"
#include "game/Bones.h"
#include "game/Steering.h"
#include "game/World.h"

#include <array>

namespace shoal::game {

namespace {

// How hard it struggles, having been held for so long; 1 at first.
float tired(float held_s) { return std::max(physics::kTiredOut, 1 - physics::kTires_Hz * held_s); }

// The way from a bone into a body.
glm::vec3 into(const physics::Capsule& bone, const physics::Capsule& flesh) {
    const physics::Nearest at = physics::nearest(bone, flesh);
    return normalizedOr(at.onSecond - at.onFirst, kUp);
}

} // namespace

void Hand::press(int part, const physics::Press& one, float depth_m) {
    presses[pressCount++] = one;
    touching[part].touches = true;
    touching[part].depth_m = std::max(touching[part].depth_m, depth_m);
}

physics::Capsule World::body(const Fish& f, float widest_m) const {
    const Species& kind = species[f.species];
    const glm::vec3 reach = f.forward * kind.bodyHalf_m;
    return {f.position - reach, f.position + reach, std::min(kind.bodyRadius_m, widest_m)};
}

void World::enclose(int index, Hand& hand) const {
    const physics::Capsule flesh = body(fish[index], physics::kEnclosed_m);
    hand.pressCount = 0;
    for (int j = 0; j < hands::kJointCount; ++j) { // the palm: rigid
        if (j == 1 || partOfBone(j) != haptics::kPalm) continue;
        const physics::Capsule at = bone(hand.joints, j);
        const float gap = physics::separation(at, flesh);
        if (gap > physics::kLift_m) continue;
        const float depth = std::max(0.0f, -gap);
        hand.press(haptics::kPalm,
                   {into(at, flesh), std::min(physics::kPalmForce_N, physics::kPalmStiffness_Npm * depth)},
                   depth);
    }
    for (int finger = 0; finger < hands::kFingerCount; ++finger) {
        const int first = finger == 0 ? 2 : 1 + 5 * finger; // its metacarpal
        physics::Finger given;
        given.count = finger == 0 ? 4 : 5;
        for (int i = 0; i < given.count; ++i) {
            given.joints[i] = hand.joints[first + i].position;
            given.radii[i] = i == 0 ? 0 : bone(hand.joints, first + i).radius;
        }
        const physics::Finger rests = physics::wrapped(given, flesh);
        for (int i = 1; i < given.count; ++i) {
            hands::Joint& shown = hand.shown[first + i];
            shown.position = rests.joints[i];
            shown.orientation = rests.turned[std::min(i + 1, given.count - 1)] * shown.orientation;
            if (!rests.touches[i]) continue;
            const physics::Capsule here{rests.joints[i - 1], rests.joints[i], given.radii[i]};
            const glm::vec3 would = 0.5f * (given.joints[i - 1] + given.joints[i]);
            const float depth = glm::distance(would, 0.5f * (here.a + here.b)) +
                                std::max(0.0f, -physics::separation(here, flesh));
            hand.press(finger, {into(here, flesh), physics::pressForce_N(depth)}, depth);
        }
    }
}

physics::Hold World::holdOn(int index, glm::vec3 asked_N) const {
    std::array<physics::Press, 2 * hands::kJointCount> presses;
    size_t count = 0;
    for (const Hand& hand : hands)
        if (hand.encloses == index)
            for (int i = 0; i < hand.pressCount; ++i) presses[count++] = hand.presses[i];
    for (const physics::Contact& contact : contacts) // of a hand that only presses on it
        if (static_cast<int>(contact.body) == index && contact.lasting &&
            hands[contact.group].encloses != index && count < presses.size())
            presses[count++] = {contact.normal, physics::pressForce_N(contact.depth)};
    return physics::hold({presses.data(), count}, asked_N);
}

void World::followHands() {
    for (const Hand& hand : hands) {
        if (hand.holds < 0) continue;
        Fish& f = fish[hand.holds];
        const glm::quat palm = hand.joints[0].orientation;
        const glm::vec3 was = f.position;
        // A beat of 4 Hz, strongest at first.
        const float wild = 0.3f * tired(f.held_s);
        const float beat = std::sin(f.held_s * physics::kBeat_radps) * wild;
        const glm::quat wriggle(1, 0, 0.5f * beat, 0.2f * beat);
        const float settle = std::min(1.0f, f.held_s / physics::kSettle_s);
        f.worldFromBody =
            glm::normalize(palm * blended(f.palmFromBody, f.palmFromBodyGoal, settle) * wriggle);
        f.position = hand.grasp + palm * (f.palmOffset + glm::vec3(0.012f * beat, 0, 0.02f * beat));
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        f.velocity = (f.position - was) / kDt;
    }
}

glm::vec3 World::askedOf(Fish& f, const Hand& hand) const {
    const Species& kind = species[f.species];
    const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
    const float beat = std::sin(f.held_s * physics::kBeat_radps);
    f.struggle = tired(f.held_s) * (0.6f + 0.4f * beat);
    const glm::vec3 thrust =
        (f.forward + 0.5f * beat * leftOf(f.forward)) * (mass * physics::kStruggle_mps2 * f.struggle);
    const float side = 2 * kind.bodyRadius_m * 2 * (kind.bodyHalf_m + kind.bodyRadius_m);
    const glm::vec3 drag = hand.calmVelocity * (0.5f * physics::kWater_kgpm3 * physics::kDragShape * side *
                                                glm::length(hand.calmVelocity));
    return thrust - drag - mass * hand.calmAcceleration;
}

void World::carry(std::vector<Event>& out) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (hand.holds < 0) continue;
        Fish& f = fish[hand.holds];
        const int index = hand.holds;
        f.held_s += kDt;
        f.bank = 0;
        f.speed = 0;
        f.gait.set(Motion::Struggle);
        f.gait.advance(1.6f);
        if (hand.solid && !slipsOn(index, h)) {
            drop(h, out);
            continue;
        }
        if (!f.counted && f.held_s >= kHoldToCatch_s + 0.5f * kDt) {
            f.counted = true;
            ++caught;
            score += species[f.species].points;
            emit(out, Event::Kind::Catch, index, h, -1, 1, f.position);
        }
        if (f.counted && f.held_s >= kHoldToCatch_s + kShowCatch_s) letGo(h, Event::Kind::Release, out);
    }
}

bool World::slipsOn(int index, int h) {
    Fish& f = fish[index];
    const Hand& hand = hands[h];
    const glm::quat palmFromWorld = glm::conjugate(hand.joints[0].orientation);
    const Species& kind = species[f.species];

    // Into the hollow of the hand at first; then friction keeps it where it lies.
    if (f.held_s < physics::kSettle_s)
        f.palmOffset +=
            (palmFromWorld *
                 (hollowOf(hand.joints[0], std::min(kind.bodyRadius_m, physics::kEnclosed_m)) - hand.grasp) -
             f.palmOffset) *
            (20 * kDt);

    const physics::Hold hold = holdOn(index, askedOf(f, hand));
    if (hold.margin_N < 0) {
        const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
        f.slide += palmFromWorld * hold.gives * (-hold.margin_N / mass * kDt);
        f.slide = limited(f.slide, physics::kSlideMost_mps);
    } else {
        f.slide *= physics::kSlideGrip;
        if (glm::dot(f.slide, f.slide) < 1e-6f) f.slid_m = 0;
    }
    f.palmOffset += f.slide * kDt;
    f.slid_m += glm::length(f.slide) * kDt;
    const bool opposed = holdOn(index, glm::vec3(0)).margin_N > 0;
    f.unopposed = opposed ? 0 : f.unopposed + 1;
    return f.slid_m < physics::kSlideOut_m && f.unopposed < physics::kUnopposed;
}

} // namespace shoal::game
