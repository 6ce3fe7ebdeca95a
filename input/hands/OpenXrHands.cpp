#include "input/hands/OpenXrHands.h"

#include "input/hands/HandFilter.h"

#include <glm/mat3x3.hpp>

#include <algorithm>

namespace shoal::hands {

// OpenXR's grip pose has -Z along the handle, from the little finger to the thumb, and +X across the palm to
// the right for both hands; so +Y points to the wrist. A joint has -Z to the fingertips and +Y out of the
// back of the hand, which on the right hand is to the right, on the left to the left.
static glm::quat gripFromWrist(Side side) {
    const glm::vec3 back(side == Side::Right ? 1.0f : -1.0f, 0, 0), toWrist(0, 1, 0);
    return glm::quat_cast(glm::mat3(glm::cross(back, toWrist), back, toWrist));
}

constexpr float kRelaxed = 0.12f; // bend of a finger that presses nothing

HandPose handFromJoints(const HandPose& inWorld, const xr::Pose& worldFromHead) {
    if (!inWorld.tracked) return {};
    HandPose hand = carried(inWorld, {worldFromHead.position, worldFromHead.orientation}, {});
    hand.grip = gripOf(hand.joints);
    hand.pinch = pinchOf(hand.joints);
    return hand;
}

HandPose handFromController(const HandRig& rig, Side side, const xr::Controller& controller,
                            const xr::Pose& worldFromHead) {
    if (!controller.worldFromGrip) return {};
    const xr::Pose headFromGrip = xr::inverse(worldFromHead) * *controller.worldFromGrip;
    const auto bend = [](float pressed) {
        return kRelaxed + (0.95f - kRelaxed) * std::clamp(pressed, 0.0f, 1.0f);
    };
    const float byTrigger = bend(controller.trigger), bySqueeze = bend(controller.squeeze);
    const HandShape shape{
        .curl = {0.8f * std::max(byTrigger, bySqueeze), byTrigger, bySqueeze, bySqueeze, bySqueeze}};
    // The grip pose lies on the palm's surface; the palm's place depends on the wrist, not on the fingers.
    HandPose hand =
        rig.pose(side, shape, {{}, glm::normalize(headFromGrip.orientation * gripFromWrist(side))});
    const Joint& palm = hand.joints[0];
    const glm::vec3 surface = palm.position - palm.orientation * glm::vec3(0, palm.radius, 0);
    for (Joint& joint : hand.joints) joint.position += headFromGrip.position - surface;
    return hand;
}

std::array<HandPose, 2> openXrHands(const HandRig& rig, const xr::Tracking& tracking) {
    std::array<HandPose, 2> hands;
    for (size_t i = 0; i < hands.size(); ++i) {
        hands[i] = handFromJoints(tracking.hands[i], tracking.worldFromHead);
        if (!hands[i].tracked)
            hands[i] = handFromController(rig, i == 0 ? Side::Left : Side::Right, tracking.controllers[i],
                                          tracking.worldFromHead);
    }
    return hands;
}

} // namespace shoal::hands
