#include "input/hands/Continuity.h"

#include "input/hands/HandTuning.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::hands {

using namespace tuning;

HandPose between(const HandPose& a, const HandPose& b, float share) {
    HandPose pose = b;
    for (int i = 0; i < kJointCount; ++i) {
        glm::quat from = a.joints[i].orientation;
        const glm::quat& to = b.joints[i].orientation;
        if (glm::dot(from, to) < 0) from = -from;
        pose.joints[i].position = glm::mix(a.joints[i].position, b.joints[i].position, share);
        const glm::quat mixed = from * (1 - share) + to * share;
        const float norm = glm::length(mixed);
        pose.joints[i].orientation = norm > 1e-3f ? mixed / norm : to;
    }
    return pose;
}

const HandPose& Continuity::step(const HandPose& seen, int stretch, float notSeen_s, float dt_s) {
    const bool known = stretch > 0 && notSeen_s <= kBridge_s;
    if (!known) {
        pose_.tracked = false;
        pose_.confidence = 0;
        glide_s_ = 0;
        stretch_ = 0;
        return pose_;
    }
    const bool shown = pose_.tracked;
    if (!shown) {
        appear_s_ = kAppear_s;
    } else if (stretch != stretch_) {
        from_ = pose_;
        const float distance = glm::distance(seen.joints[0].position, pose_.joints[0].position);
        glideLength_s_ = glide_s_ = std::clamp(distance / kGlide_mps, kGlideLeast_s, kGlideMost_s);
        from_.solid = pose_.solid && distance < kNear_m;
    }
    stretch_ = stretch;
    appear_s_ = std::max(0.0f, appear_s_ - dt_s);
    glide_s_ = std::max(0.0f, glide_s_ - dt_s);
    if (glide_s_ > 0) {
        const float t = 1 - glide_s_ / glideLength_s_;
        pose_ = between(from_, seen, t * t * (3 - 2 * t));
    } else {
        pose_ = seen;
    }
    pose_.tracked = true;
    pose_.solid = seen.solid && appear_s_ <= 0 && (glide_s_ <= 0 || from_.solid);
    pose_.confidence = seen.confidence * std::max(0.0f, 1 - notSeen_s / kBridge_s);
    return pose_;
}

} // namespace shoal::hands
