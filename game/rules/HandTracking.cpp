#include "game/rules/HandTracking.h"

#include "engine/physics/ContactModel.h"
#include "game/rules/Swimmer.h"

#include <algorithm>

namespace shoal::game {

namespace {

constexpr int kKeepTicks = 12; // a hand lost for less than 0.1 s stays where it was

bool nearUnit(const glm::quat& q) {
    const float norm = glm::dot(q, q);
    return norm > 0.9f && norm < 1.1f; // false for NaN
}

// Zeroes the velocities of a hand that appears or jumps, so that it pushes no fish and takes hold of none.
void stop(Hand& hand) {
    hand.velocity = hand.calmVelocity = hand.ownVelocity = hand.calmAcceleration = glm::vec3(0);
    hand.velocities.fill(glm::vec3(0));
    hand.grasp.window = 0;
}

void believe(const hands::HandPose& given, Hand& hand) {
    if (given.tracked && hands::plausible(given)) {
        hand.lastGood = given;
        hand.known = true;
        hand.untrackedTicks = 0;
    } else
        ++hand.untrackedTicks;
    hand.visible = hand.known && hand.untrackedTicks <= kKeepTicks;
    hand.solid = hand.visible && hand.lastGood.solid;
    if (!hand.visible) hand.untrackedTicks = std::min(hand.untrackedTicks, 10 * kHandDropTicks);
}

void placeJoints(const Viewpoint& view, Hand& hand) {
    for (int j = 0; j < hands::kJointCount; ++j) {
        hand.joints[j] = hand.lastGood.joints[j];
        hand.joints[j].position =
            view.headWorld + view.worldFromView * (hand.joints[j].position + hand.intent.movedView);
        hand.joints[j].orientation = view.worldFromView * hand.joints[j].orientation;
    }
    hand.fingers.shown = hand.joints;
    hand.graspCentre = hands::graspCentre(hand.joints);
    hand.grip = std::clamp(hand.lastGood.grip, 0.0f, 1.0f);
}

// Marks a hand that appears as a fist as closed already, so that it takes hold of nothing.
void startGrasp(Hand& hand) {
    hand.fingers.lifts = {};
    hand.grasp.closed = hand.grasp.holds >= 0 || hand.grip > kGripCloses;
    hand.grasp.firmest = std::max(hand.grip, kGripOpens);
}

// palmBefore: the palm's position in the last tick, viewer's frame.
void updateVelocities(glm::vec3 palmBefore, const Viewpoint& view, Hand& hand) {
    hand.velocity = (hand.palm().position - hand.before[hands::kPalmJoint].position) / kDt;
    const glm::vec3 change = (hand.velocity - hand.calmVelocity) * (1.0f / 6);
    hand.calmVelocity += change;
    const glm::vec3 own =
        view.worldFromView * ((hand.lastGood.joints[hands::kPalmJoint].position - palmBefore) / kDt);
    hand.ownVelocity += (own - hand.ownVelocity) * (1.0f / 6);
    hand.calmAcceleration += (change / kDt - hand.calmAcceleration) * (1.0f / 6);
    for (int j = 0; j < hands::kJointCount; ++j) {
        const glm::vec3 now = (hand.joints[j].position - hand.before[j].position) / kDt;
        hand.velocities[j] += (now - hand.velocities[j]) * (1.0f / 3);
    }
}

void trackHand(const hands::HandPose& given, const Viewpoint& view, Hand& hand) {
    const bool appears = !hand.visible;
    const glm::vec3 palmBefore = hand.lastGood.joints[hands::kPalmJoint].position;
    believe(given, hand);
    hand.touching = {};
    hand.fingers.pressCount = 0;
    if (!hand.visible) return stop(hand);
    if (!appears) hand.before = hand.joints;
    if (appears) hand.intent = {};
    const float gripBefore = hand.grip;
    placeJoints(view, hand);
    const float closing_Hz = appears ? 0 : (hand.grip - gripBefore) / kDt;
    hand.intent.closing_Hz += (closing_Hz - hand.intent.closing_Hz) * (1.0f / 4);
    if (appears) startGrasp(hand);
    const bool replaced =
        glm::distance(hand.palm().position, hand.before[hands::kPalmJoint].position) > physics::kTeleport_m;
    if (appears || replaced || !hand.solid) {
        hand.before = hand.joints;
        stop(hand);
    } else
        updateVelocities(palmBefore, view, hand);
}

} // namespace

void trackHands(const TickInput& input, Viewpoint& view, Hands& hands) {
    if (nearUnit(input.worldFromView)) view.worldFromView = glm::normalize(input.worldFromView);
    if (glm::dot(input.headWorld, input.headWorld) <= kHeadReach_m * kHeadReach_m)
        view.headWorld = input.headWorld;
    for (size_t i = 0; i < hands.size(); ++i) trackHand(input.hands[i], view, hands[i]);
}

} // namespace shoal::game
