#include "engine/physics/Finger.h"

#include "engine/physics/ContactModel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::physics {

namespace {

const glm::quat kStill(1, 0, 0, 0);

// The smallest turn from one direction to another; both unit.
glm::quat arc(glm::vec3 from, glm::vec3 to) {
    const glm::vec3 axis = glm::cross(from, to);
    const glm::quat q(1 + glm::dot(from, to), axis.x, axis.y, axis.z);
    const float squared = glm::dot(q, q);
    return squared > 1e-8f ? q / std::sqrt(squared) : kStill; // folded back upon itself: no bones do that
}

glm::quat share(const glm::quat& turn, float t) { return glm::normalize(kStill * (1 - t) + turn * t); }

} // namespace

Finger wrapped(const Finger& given, const Capsule& body) {
    Finger out = given;
    out.turned.fill(kStill);
    out.touches.fill(false);
    std::array<glm::vec3, hands::kMaxFingerJoints> along{}; // unit, of the bone that ends there
    std::array<float, hands::kMaxFingerJoints> length{};
    for (int i = 1; i < given.count; ++i) {
        const glm::vec3 bone = given.joints[i] - given.joints[i - 1];
        length[i] = glm::length(bone);
        along[i] = length[i] > 1e-6f ? bone / length[i] : (i > 1 ? along[i - 1] : glm::vec3(0, 0, -1));
    }
    glm::quat before = kStill; // turn of the bone before
    for (int i = 2; i < given.count; ++i) {
        const glm::quat bend = arc(along[i - 1], along[i]);
        // The rest of the finger, straight, turns about this knuckle. Conservative advancement again: it may
        // turn by the gap over its length. d(angle)/dt of share() is at most 4 tan(angle / 4).
        float reach = 0;
        for (int j = i; j < given.count; ++j) reach += length[j];
        const float fastest = 4 * std::sqrt(std::max(0.0f, 1 - bend.w) / (1 + std::max(0.0f, bend.w)));
        float t = 0;
        for (int step = 0; step < kAdvances; ++step) {
            const glm::vec3 direction = before * (share(bend, t) * along[i - 1]);
            const glm::vec3 root = out.joints[i - 1];
            float gap = 1, from = 0;
            for (int j = i; j < given.count; ++j) {
                gap = std::min(gap, separation({root + direction * from,
                                                root + direction * (from + length[j]), given.radii[j]},
                                               body));
                from += length[j];
            }
            if (gap <= kTouchGap_m || fastest * reach < 1e-6f) break;
            t += gap / (fastest * reach);
            if (t >= 1) {
                t = 1;
                break;
            }
        }
        const glm::quat here = before * share(bend, t);
        out.joints[i] = out.joints[i - 1] + here * along[i - 1] * length[i];
        before = glm::normalize(here * glm::conjugate(bend));
        out.turned[i] = before;
    }
    for (int i = 2; i < given.count; ++i)
        out.touches[i] = separation({out.joints[i - 1], out.joints[i], given.radii[i]}, body) < kLift_m;
    return out;
}

} // namespace shoal::physics
