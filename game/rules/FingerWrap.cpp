#include "game/rules/FingerWrap.h"

#include "engine/physics/ContactModel.h"
#include "engine/physics/Finger.h"
#include "game/rules/Bones.h"
#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

namespace {

// The way from a bone into a body.
glm::vec3 into(const physics::Capsule& bone, const physics::Capsule& body) {
    const physics::Nearest at = physics::nearest(bone, body);
    return normalizedOr(at.onSecond - at.onFirst, kUp);
}

void press(Hand& hand, int part, const physics::Press& one, float depth_m) {
    hand.fingers.presses[hand.fingers.pressCount++] = one;
    hand.touching[part].touches = true;
    hand.touching[part].depth_m = std::max(hand.touching[part].depth_m, depth_m);
}

void pressPalm(const physics::Capsule& body, Hand& hand) { // which is rigid
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

} // namespace shoal::game
