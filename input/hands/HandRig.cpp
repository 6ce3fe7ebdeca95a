#include "input/hands/HandRig.h"

#include "engine/math/Trigonometry.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

namespace shoal::hands {

namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180;

// Bend of each joint at curl 1 about its own X, towards the palm: ranges of a relaxed fist. Spread: turn
// about its own Y at spread 1; positive towards the thumb's side of a right hand.
struct Range {
    float bend_deg = 0, spread_deg = 0;
};
constexpr std::array<Range, kJointCount> kRanges = {{
    {},       {},                        // palm, wrist
    {15, 15}, {40},      {60}, {},       // thumb
    {},       {80, 10},  {95}, {60}, {}, // index
    {},       {80, 2},   {95}, {60}, {}, // middle
    {},       {80, -6},  {95}, {60}, {}, // ring
    {},       {80, -13}, {95}, {60}, {}, // little
}};

// Throws nlohmann's exceptions if the JSON is not a list of three numbers.
glm::vec3 vectorFrom(const nlohmann::json& json) {
    const auto v = json.get<std::array<float, 3>>();
    return {v[0], v[1], v[2]};
}

} // namespace

Result<HandRig> HandRig::load(const Path& file) {
    auto text = readText(file, 1u << 20);
    if (!text) return text.error();
    std::array<glm::vec3, kJointCount> position{}, up{};
    HandRig rig;
    try {
        const auto list = nlohmann::json::parse(*text).at("joints");
        for (int i = 0; i < kJointCount; ++i) {
            position[i] = vectorFrom(list.at(i).at("position"));
            up[i] = vectorFrom(list.at(i).at("up"));
            rig.radius_[i] = list.at(i).at("radius").get<float>();
        }
    } catch (const nlohmann::json::exception&) {
        return Error{file.string(), "is no hand skeleton: 26 joints, each with position, up and radius"};
    }

    std::array<glm::quat, kJointCount> turn{};
    for (int i = 0; i < kJointCount; ++i) {
        if (isTip(i)) {
            turn[i] = turn[kJointParent[i]];
            continue;
        }
        // Palm and wrist look along the middle finger, all others at the next joint.
        const int next = fingerOfJoint(i) < 0 ? kFingerJoints[2].proximal : i + 1;
        turn[i] = glm::normalize(glm::quatLookAt(glm::normalize(position[next] - position[i]), up[i]));
    }
    for (int i = 0; i < kJointCount; ++i) {
        const int parent = kJointParent[i];
        if (parent < 0) continue;
        const glm::quat parentFromRest = glm::conjugate(turn[parent]);
        rig.parentFromJointOffset_[i] = parentFromRest * (position[i] - position[parent]);
        rig.parentFromJointTurn_[i] = parentFromRest * turn[i];
    }
    return rig;
}

HandPose HandRig::pose(Side side, const HandShape& shape, const JointPose& wrist) const {
    HandPose hand{.tracked = true, .confidence = 1};
    const auto place = [&](int i) { // of a right hand with its wrist at the origin
        Joint& joint = hand.joints[i];
        joint.radius = radius_[i];
        if (i == kWristJoint) return;
        const Joint& parent = hand.joints[kJointParent[i]];
        joint.position = parent.position + parent.orientation * parentFromJointOffset_[i];
        joint.orientation = parent.orientation * parentFromJointTurn_[i];
        const int finger = fingerOfJoint(i);
        if (finger < 0) return;
        const float bend = -(kRanges[i].bend_deg * kDegree) * std::clamp(shape.curl[finger], 0.0f, 1.0f);
        const float spread = kRanges[i].spread_deg * kDegree * std::clamp(shape.spread, -1.0f, 1.0f);
        if (spread != 0)
            joint.orientation = joint.orientation * math::rotationAbout(glm::vec3(0, 1, 0), spread);
        if (bend != 0) joint.orientation = joint.orientation * math::rotationAbout(glm::vec3(1, 0, 0), bend);
        joint.orientation = glm::normalize(joint.orientation);
    };
    place(kWristJoint); // parents first
    place(kPalmJoint);
    for (int i = kWristJoint + 1; i < kJointCount; ++i) place(i);

    for (Joint& joint : hand.joints) {
        if (side == Side::Left) { // mirrors it
            joint.position.x = -joint.position.x;
            joint.orientation.y = -joint.orientation.y;
            joint.orientation.z = -joint.orientation.z;
        }
        joint.position = wrist.position + wrist.orientation * joint.position;
        joint.orientation = wrist.orientation * joint.orientation;
    }
    hand.grip = gripOf(hand.joints);
    hand.pinch = pinchOf(hand.joints);
    return hand;
}

float gripOf(const std::array<Joint, kJointCount>& joints) {
    // Sum of the three knuckles' bends, averaged over the fingers: a relaxed open hand, and a fist.
    constexpr float kOpen = 30 * kDegree, kFist = 200 * kDegree;
    float sum = 0;
    for (int finger = 1; finger < kFingerCount; ++finger)
        for (int i = kFingerJoints[finger].metacarpal; i + 2 <= kFingerJoints[finger].tip; ++i) {
            const glm::vec3 here = joints[i + 1].position - joints[i].position;
            const glm::vec3 next = joints[i + 2].position - joints[i + 1].position;
            const float scale = glm::length(here) * glm::length(next);
            if (scale > 1e-9f) sum += math::arcCosine(glm::dot(here, next) / scale);
        }
    return std::clamp((sum / 4 - kOpen) / (kFist - kOpen), 0.0f, 1.0f);
}

float pinchOf(const std::array<Joint, kJointCount>& joints) {
    constexpr float kFar_m = 0.05f; // gap between the tips' surfaces that counts as open
    const Joint &thumb = joints[kFingerJoints[0].tip], &index = joints[kFingerJoints[1].tip];
    const float gap = glm::distance(thumb.position, index.position) - thumb.radius - index.radius;
    return std::clamp(1 - gap / kFar_m, 0.0f, 1.0f);
}

} // namespace shoal::hands
