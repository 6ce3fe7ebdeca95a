#include "game/views/ArmPose.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::app {

// Position of the right shoulder from the eyes, yawed frame (+x right, +y up, +z behind), metres: for a
// person of 1.75 m.
constexpr glm::vec3 kShoulder{0.21f, -0.29f, 0.06f};
// Least distances of the shoulder: behind the plane through the eyes, and from the line of sight.
constexpr float kBehindEyes_m = 0.03f, kAside_m = 0.33f;
// Direction in which a loosely hanging right elbow points, same frame: down, outwards and back.
constexpr glm::vec3 kElbowHint{0.60f, -0.72f, 0.35f};
// The same direction in the model's arm at rest: arms.py's POINT.
constexpr glm::vec3 kElbowAtRest{0.6f, -0.8f, 0};

static glm::vec3 ofSide(hands::Side side, const glm::vec3& right) {
    return side == hands::Side::Left ? glm::vec3(-right.x, right.y, right.z) : right;
}

// Returns the yaw about the world's up; ahead stays ahead as seen from above, however the head tilts.
static glm::quat yawOf(const glm::quat& worldFromView) {
    const glm::vec3 ahead = worldFromView * glm::vec3(0, 0, -1), up = worldFromView * glm::vec3(0, 1, 0);
    const glm::vec3 level = ahead - up * ahead.y; // the up of a head that looks down is ahead of it
    return glm::angleAxis(std::atan2(-level.x, -level.z), glm::vec3(0, 1, 0));
}

// Returns the unit component of v perpendicular to the axis, which may be 0; of `otherwise` if v is parallel.
static glm::vec3 across(const glm::vec3& v, const glm::vec3& axis, const glm::vec3& otherwise) {
    glm::vec3 part = v - axis * glm::dot(v, axis);
    if (glm::dot(part, part) < 1e-6f) part = otherwise - axis * glm::dot(otherwise, axis);
    return glm::normalize(part);
}

// Returns the unit direction, perpendicular to the unit vector `back`, in which the elbow bends. `given` has
// no weight where it is close to that line, as its direction around the line is noise there.
static glm::vec3 elbowPoint(const glm::vec3& hint, const glm::vec3& given, const glm::vec3& back,
                            const glm::vec3& aside) {
    constexpr float kNone = 0.05f, kFull = 0.2f; // sines: 3 and 12 degrees
    const glm::vec3 loose = across(hint, back, aside);
    const float sine = glm::length(given - back * glm::dot(given, back));
    const float trust = glm::smoothstep(kNone, kFull, sine);
    return trust > 0 ? across(glm::mix(loose, across(given, back, loose), trust), back, loose) : loose;
}

// Returns the rotation of +Z to `axis` and of kElbowAtRest of this side to `point`, perpendicular to `axis`.
static glm::quat frameOf(hands::Side side, const glm::vec3& axis, const glm::vec3& point) {
    const glm::vec3 rest = ofSide(side, kElbowAtRest);
    const glm::mat3 from(rest, glm::cross(glm::vec3(0, 0, 1), rest), glm::vec3(0, 0, 1));
    const glm::mat3 to(point, glm::cross(axis, point), axis);
    return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

glm::vec3 shoulderWorld(hands::Side side, const Head& head) {
    const glm::vec3 fromHead = yawOf(head.worldFromView) * ofSide(side, kShoulder);
    glm::vec3 inView = glm::conjugate(head.worldFromView) * fromHead;
    const float aside_m = std::max(std::hypot(inView.x, inView.y), 1e-3f);
    const float outwards = std::max(kAside_m / aside_m, 1.0f);
    inView = {inView.x * outwards, inView.y * outwards, std::max(inView.z, kBehindEyes_m)};
    return head.positionWorld + head.worldFromView * inView;
}

ArmPose poseArm(hands::Side side, const hands::Joint& wristWorld, const Head& head,
                const glm::vec3& towardsElbow) {
    const glm::vec3 shoulder = shoulderWorld(side, head), wrist = wristWorld.position;
    const glm::quat yaw = yawOf(head.worldFromView);
    const glm::vec3 hint = yaw * ofSide(side, kElbowHint), aside = yaw * ofSide(side, {1, 0, 0});
    const glm::vec3 apart = shoulder - wrist;
    // The triangle needs a distance of at least the difference of both bones' lengths.
    const float distance = std::max(glm::length(apart), kUpperArm_m - kForearm_m + 1e-3f);
    const glm::vec3 back = across(apart, glm::vec3(0), yaw * glm::vec3(0, 0, 1));
    const glm::vec3 point = elbowPoint(hint, towardsElbow, back, aside);
    // Two-bone inverse kinematics: the triangle of both bones and the distance, by the law of cosines.
    const float stretch = std::max(distance / (kForearm_m + kUpperArm_m), 1.0f);
    const float fore = kForearm_m * stretch, upper = kUpperArm_m * stretch;
    const float along =
        std::clamp((distance * distance + fore * fore - upper * upper) / (2 * distance), -fore, fore);
    const glm::vec3 elbow = wrist + along * back + std::sqrt(fore * fore - along * along) * point;

    const glm::vec3 foreAxis = (elbow - wrist) / fore, upperAxis = (wrist + distance * back - elbow) / upper;
    const glm::vec3 hinge = glm::cross(back, point); // the elbow's axis, perpendicular to both bones
    const glm::quat forearm = frameOf(side, foreAxis, glm::cross(hinge, foreAxis));
    const glm::quat upperArm = frameOf(side, upperAxis, glm::cross(hinge, upperAxis));
    // The hand's rotation without the bend of the wrist; the middle of the forearm takes half of its twist.
    const glm::quat hand = wristWorld.orientation;
    const glm::quat end = glm::quat(hand * glm::vec3(0, 0, 1), foreAxis) * hand; // the shortest turn
    const auto at = [](const glm::vec3& place, const glm::quat& turn) {
        return glm::translate(glm::mat4(1), place) * glm::mat4_cast(turn);
    };
    return {at(wrist, hand),
            at(wrist, end),
            at(0.5f * (wrist + elbow), glm::slerp(forearm, end, 0.5f)),
            at(elbow, forearm),
            at(elbow, glm::slerp(forearm, upperArm, 0.5f)),
            at(elbow, upperArm),
            at(shoulder, upperArm)};
}

float stretchOf(const ArmPose& arm) {
    const auto place = [&](ArmJoint joint) { return glm::vec3(arm[static_cast<size_t>(joint)][3]); };
    return glm::distance(place(ArmJoint::UpperArm), place(ArmJoint::UpperArmEnd)) / kUpperArm_m;
}

} // namespace shoal::app
