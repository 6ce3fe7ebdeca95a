#include "input/hands/MouseHands.h"

#include "engine/math/Trigonometry.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::hands {

constexpr float kCloseTime_s = 0.12f;
constexpr float kFollow_s = 0.025f;   // the hand lags the cursor by about this: no jitter, no felt delay
constexpr float kSwap_s = 0.09f;      // time constant of the other hand's way to its place
constexpr float kReach_s = 0.12f;     // time in which the help closes a gap in depth
constexpr float kReach_mps = 0.55f;   // its greatest speed: a faster hand would frighten the fish
constexpr float kReachEase_s = 0.05f; // time in which it changes its speed
constexpr float kWheelRest_s = 1.2f;  // time for which the wheel's choice stands against the help...
constexpr float kWheelFades_s = 1;    // ...and in which it fades then
constexpr float kNotch = 1.06f;       // reach per notch

static glm::vec3 restingPlace(Side side, float tanX, float tanY) {
    const float sign = side == Side::Left ? -1.0f : 1.0f;
    const float z = 0.5f;
    return {sign * z * std::min(0.62f * tanX, 0.6f), -z * 0.88f * tanY, -z};
}

// Returns the upper right corner of the picture at a metre's distance.
static glm::vec2 cornerOf(const MouseInput& input) {
    const float half = 0.5f * std::clamp(input.fovY, 0.2f, 2.6f);
    const float tanY = math::sine(half) / math::cosine(half);
    return {tanY * std::clamp(input.aspect, 0.1f, 10.0f), tanY};
}

glm::vec3 rayThroughCursor(const MouseInput& input) {
    const glm::vec2 at = glm::clamp(input.cursor, glm::vec2(-1), glm::vec2(1)) * cornerOf(input);
    return glm::normalize(glm::vec3(at, -1));
}

HandPose reachingHand(const HandRig& rig, Side side, glm::vec3 grasp, float closed) {
    const float sign = side == Side::Left ? -1.0f : 1.0f;
    const glm::vec3 shoulder(sign * 0.18f, -0.24f, 0.04f);
    // Fingers point along the forearm and slightly up; the hand's back faces outwards, up and the player.
    const glm::vec3 fingers = glm::normalize(glm::normalize(grasp - shoulder) + glm::vec3(0, 0.35f, 0));
    const glm::vec3 back = glm::vec3(sign * 0.65f, 0.6f, 0.35f);
    const float smooth = closed * closed * (3 - 2 * closed);
    const HandShape shape{.curl = {0.05f + 0.75f * smooth, 0.10f + 0.80f * smooth, 0.12f + 0.80f * smooth,
                                   0.14f + 0.80f * smooth, 0.16f + 0.80f * smooth},
                          .spread = 0.5f * (1 - smooth)};
    HandPose hand = rig.pose(side, shape, {{}, glm::normalize(glm::quatLookAt(fingers, back))});
    const glm::vec3 wrist = grasp - graspCentre(hand.joints);
    for (Joint& joint : hand.joints) joint.position += wrist;
    return hand;
}

float MouseHands::distance_m() const { return std::clamp(distance_m_ * wheel_, kReachMin_m, kReachMax_m); }

void MouseHands::followReach(const MouseInput& input, float dt_s) {
    wheelRests_s_ = std::max(0.0f, wheelRests_s_ - dt_s);
    if (input.wheel != 0) {
        const float turned = wheel_ * std::pow(kNotch, std::clamp(input.wheel, -20.0f, 20.0f));
        wheel_ = std::clamp(turned, kReachMin_m / distance_m_, kReachMax_m / distance_m_);
        wheelRests_s_ = kWheelRest_s;
    }
    const bool closed = hands_[active_ == Side::Left ? 0 : 1].closed >= 1;
    const float help = std::clamp(input.reachHelp, 0.0f, 1.0f);
    const bool helps = input.reach_m && help > 0 && !closed;
    float wanted_mps = 0;
    if (helps)
        wanted_mps = std::clamp(help * (*input.reach_m - distance_m_) / kReach_s, -kReach_mps, kReach_mps);
    reachSpeed_mps_ += (wanted_mps - reachSpeed_mps_) * math::followShare(dt_s, kReachEase_s);
    if (closed) reachSpeed_mps_ = 0; // a closed hand stays where it closed
    distance_m_ = std::clamp(distance_m_ + reachSpeed_mps_ * dt_s, kReachMin_m, kReachMax_m);
    if (helps && wheelRests_s_ == 0) wheel_ += (1 - wheel_) * math::followShare(dt_s, kWheelFades_s);
}

const std::array<HandPose, 2>& MouseHands::update(const MouseInput& input, float dt_s) {
    dt_s = std::isfinite(dt_s) ? std::clamp(dt_s, 0.0f, 0.1f) : 0.0f;
    if (input.swapHands) active_ = active_ == Side::Left ? Side::Right : Side::Left;

    followReach(input, dt_s);

    const glm::vec2 corner = cornerOf(input);
    const glm::vec3 ray = rayThroughCursor(input);

    for (int i = 0; i < 2; ++i) {
        const Side side = i == 0 ? Side::Left : Side::Right;
        const bool active = side == active_;
        Hand& hand = hands_[i];
        const glm::vec3 goal = active ? ray * distance_m() : restingPlace(side, corner.x, corner.y);
        if (hand.grasp)
            *hand.grasp += (goal - *hand.grasp) * math::followShare(dt_s, active ? kFollow_s : kSwap_s);
        else
            hand.grasp = goal;
        const float closedGoal = active ? input.close : (hand.closed > 0.5f ? 1.0f : 0.0f);
        const float step = dt_s / kCloseTime_s;
        hand.closed += std::clamp(closedGoal - hand.closed, -step, step);
        poses_[i] = reachingHand(rig_, side, *hand.grasp, hand.closed);
    }
    return poses_;
}

} // namespace shoal::hands
