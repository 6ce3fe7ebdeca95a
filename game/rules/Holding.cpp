#include "game/rules/Holding.h"

#include "engine/math/Trigonometry.h"
#include "engine/physics/ContactModel.h"
#include "engine/physics/Grip.h"
#include "game/rules/Hand.h"
#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

namespace {

// Returns the direction from a bone into a body, unit length.
glm::vec3 into(const physics::Capsule& bone, const physics::Capsule& body) {
    const physics::Nearest at = physics::nearest(bone, body);
    return normalizedOr(at.onSecond - at.onFirst, kUp);
}

void press(Hand& hand, int part, const physics::Press& one, float depth_m) {
    hand.fingers.presses[hand.fingers.pressCount++] = one;
    hand.touching[part].touches = true;
    hand.touching[part].depth_m = std::max(hand.touching[part].depth_m, depth_m);
}

void pressPalm(const physics::Capsule& body, Hand& hand) { // the palm is rigid
    for (int j = 0; j < hands::kJointCount; ++j) {
        if (j == hands::kWristJoint || partOfBone(j) != hands::kPalmPart) continue;
        const physics::Capsule at = bone(hand.joints, j);
        const float gap = physics::separation(at, body);
        if (gap > physics::kLift_m) continue;
        const float depth = std::max(0.0f, -gap);
        press(hand, hands::kPalmPart,
              {into(at, body), std::min(physics::kPalmForce_N, physics::kPalmStiffness_Npm * depth)}, depth);
    }
}

void wrapFinger(int finger, const physics::Capsule& body, Hand& hand) {
    const int first = hands::kFingerJoints[finger].metacarpal;
    physics::Finger given;
    given.count = hands::kFingerJoints[finger].count();
    for (int i = 0; i < given.count; ++i) {
        given.joints[i] = hand.joints[first + i].position;
        given.radii[i] = i == 0 ? 0 : bone(hand.joints, first + i).radius;
    }
    const physics::Finger rests = physics::wrapped(given, body);
    for (int i = 1; i < given.count; ++i) {
        hands::Joint& shown = hand.fingers.shown[first + i];
        shown.position = rests.joints[i];
        shown.orientation = rests.turned[std::min(i + 1, given.count - 1)] * shown.orientation;
        if (!rests.touches[i]) continue;
        const physics::Capsule here{rests.joints[i - 1], rests.joints[i], given.radii[i]};
        const glm::vec3 would = 0.5f * (given.joints[i - 1] + given.joints[i]);
        const float depth =
            glm::distance(would, 0.5f * (here.a + here.b)) + std::max(0.0f, -physics::separation(here, body));
        press(hand, finger, {into(here, body), physics::pressForce_N(depth)}, depth);
    }
}

// Returns the strength of its struggle after so long in a hand; 1 at first.
float tired(float held_s) { return std::max(physics::kTiredOut, 1 - physics::kTires_Hz * held_s); }

// Returns the beat of its tail, -1 to 1.
float tailBeat(const Fish& f) { return math::sine(f.held_s * physics::kBeat_radps); }

// Returns the force that a held fish asks of the grip.
glm::vec3 askedForce_N(Fish& f, const Species& kind, const Hand& hand) {
    const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
    const float beat = tailBeat(f);
    f.struggle = tired(f.held_s) * (0.6f + 0.4f * beat);
    const glm::vec3 thrust =
        (f.forward + 0.5f * beat * leftOf(f.forward)) * (mass * physics::kStruggle_mps2 * f.struggle);
    const float side = 2 * kind.bodyRadius_m * 2 * (kind.bodyHalf_m + kind.bodyRadius_m);
    const glm::vec3 drag = hand.calmVelocity * (0.5f * physics::kWater_kgpm3 * physics::kDragShape * side *
                                                glm::length(hand.calmVelocity));
    return thrust - drag - mass * hand.calmAcceleration;
}

} // namespace

void wrapFingers(const physics::Capsule& body, Hand& hand) {
    hand.fingers.pressCount = 0;
    pressPalm(body, hand);
    for (int finger = 0; finger < hands::kFingerCount; ++finger) wrapFinger(finger, body, hand);
}

void easeFingers(Hand& hand) {
    const glm::quat palm = hand.palm().orientation, palmFromWorld = glm::conjugate(palm);
    for (int j = 0; j < hands::kJointCount; ++j) {
        const hands::Joint& seen = hand.joints[j];
        hands::Joint& shown = hand.fingers.shown[j];
        FingerWrap::Lift& lift = hand.fingers.lifts[j];
        const glm::vec3 move = palmFromWorld * (shown.position - seen.position);
        const glm::quat turn = palmFromWorld * shown.orientation * glm::conjugate(seen.orientation) * palm;
        lift.move += (move - lift.move) * physics::kEase;
        lift.turn = blended(lift.turn, turn, physics::kEase);
        shown.position = seen.position + palm * lift.move;
        shown.orientation = palm * lift.turn * palmFromWorld * seen.orientation;
    }
}

physics::Hold holdOn(int fish, const Hands& hands, std::span<const physics::Contact> contacts,
                     glm::vec3 asked_N) {
    std::array<physics::Press, 2 * hands::kJointCount> presses;
    size_t count = 0;
    for (const Hand& hand : hands)
        if (hand.grasp.encloses == fish)
            for (int i = 0; i < hand.fingers.pressCount; ++i) presses[count++] = hand.fingers.presses[i];
    for (const physics::Contact& contact : contacts) // of a hand that only presses on it
        if (static_cast<int>(contact.body) == fish && contact.lasting &&
            hands[contact.group].grasp.encloses != fish && count < presses.size())
            presses[count++] = {contact.normal, physics::pressForce_N(contact.depth)};
    return physics::hold({presses.data(), count}, asked_N);
}

void followHands(const Hands& hands, std::span<Fish> fish) {
    for (const Hand& hand : hands) {
        if (hand.grasp.holds < 0) continue;
        Fish& f = fish[hand.grasp.holds];
        const glm::quat palm = hand.palm().orientation;
        const glm::vec3 was = f.position;
        // The tail beats at 4 Hz, strongest at first.
        const float beat = tailBeat(f) * (0.3f * tired(f.held_s));
        const glm::quat wriggle(1, 0, 0.5f * beat, 0.2f * beat);
        const float settle = std::min(1.0f, f.held_s / physics::kSettle_s);
        f.worldFromBody =
            glm::normalize(palm * blended(f.palmFromBody, f.palmFromBodyGoal, settle) * wriggle);
        f.position = hand.graspCentre + palm * (f.palmOffset + glm::vec3(0.012f * beat, 0, 0.02f * beat));
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        f.velocity = (f.position - was) / kDt;
    }
}

void struggle(Fish& f, const Hand& hand, Random& random) {
    if (f.held_s == 0) {
        f.struggling = true;
        f.struggle_s = 0.45f;
    } else if ((f.struggle_s -= kDt) <= 0) {
        f.struggling = !f.struggling;
        f.struggle_s = f.struggling ? random.between(0.25f, 0.45f) : random.between(0.15f, 0.35f);
    }
    const float fresh = std::max(0.4f, 1 - 0.35f * f.held_s);
    f.shape.beats += (f.struggling ? 6.0f : 2.0f) * kDt;
    f.shape.amplitude = eased(f.shape.amplitude, f.struggling ? 0.17f * fresh : 0.03f, 25);
    const glm::vec3 left = f.worldFromBody * glm::vec3(1, 0, 0), up = f.worldFromBody * kUp;
    const float curl = f.struggling ? 0.9f * fresh : 0.5f;
    f.shape.bendLeft = eased(f.shape.bendLeft, curl * glm::dot(left, hand.outOfPalm()), 12);
    f.shape.bendUp = eased(f.shape.bendUp, 0.4f * curl * glm::dot(up, hand.outOfPalm()), 12);
    f.shape.finsDown = eased(f.shape.finsDown, 0, 6);
    f.coasting = false;
    f.flight_s = f.flightSide = 0;
    f.spin = glm::vec3(0);
}

bool keepsHold(Fish& f, int id, const Species& kind, const Hands& hands, int h,
               std::span<const physics::Contact> contacts) {
    const Hand& hand = hands[h];
    const glm::quat palmFromWorld = glm::conjugate(hand.palm().orientation);

    // The fish is drawn into the hollow of the hand at first; then friction keeps it where it lies.
    if (f.held_s < physics::kSettle_s)
        f.palmOffset +=
            (palmFromWorld * (hollowOf(hand.palm(), std::min(kind.bodyRadius_m, physics::kEnclosed_m)) -
                              hand.graspCentre) -
             f.palmOffset) *
            (20 * kDt);

    const physics::Hold hold = holdOn(id, hands, contacts, askedForce_N(f, kind, hand));
    if (hold.margin_N < 0) {
        const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
        f.slide += palmFromWorld * hold.gives * (-hold.margin_N / mass * kDt);
        f.slide = limited(f.slide, physics::kSlideMax_mps);
    } else {
        f.slide *= physics::kSlideGrip;
        if (glm::dot(f.slide, f.slide) < 1e-6f) f.slid_m = 0;
    }
    f.palmOffset += f.slide * kDt;
    f.slid_m += glm::length(f.slide) * kDt;
    const bool opposed = holdOn(id, hands, contacts, glm::vec3(0)).margin_N > 0;
    f.unopposed = opposed ? 0 : f.unopposed + 1;
    return f.slid_m < physics::kSlideOut_m && f.unopposed < physics::kUnopposed;
}

} // namespace shoal::game
