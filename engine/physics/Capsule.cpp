#include "engine/physics/Capsule.h"

#include "engine/physics/ContactModel.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::physics {

Nearest nearest(const Capsule& p, const Capsule& q) {
    const glm::vec3 d1 = p.b - p.a, d2 = q.b - q.a, r = p.a - q.a;
    const float a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, r);
    constexpr float kPoint = 1e-12f; // squared length of a segment that counts as a point
    float s = 0, t = 0;
    if (a <= kPoint && e > kPoint) {
        t = std::clamp(f / e, 0.0f, 1.0f);
    } else if (a > kPoint) {
        const float c = glm::dot(d1, r);
        if (e <= kPoint) {
            s = std::clamp(-c / a, 0.0f, 1.0f);
        } else {
            const float b = glm::dot(d1, d2);
            const float denominator = a * e - b * b;
            if (denominator > kPoint) s = std::clamp((b * f - c * e) / denominator, 0.0f, 1.0f);
            t = (b * s + f) / e;
            if (t < 0) {
                t = 0;
                s = std::clamp(-c / a, 0.0f, 1.0f);
            } else if (t > 1) {
                t = 1;
                s = std::clamp((b - c) / a, 0.0f, 1.0f);
            }
        }
    }
    return {p.a + d1 * s, q.a + d2 * t};
}

float separation(const Capsule& p, const Capsule& q) {
    const Nearest at = nearest(p, q);
    return glm::distance(at.onFirst, at.onSecond) - p.radius - q.radius;
}

Capsule between(const Capsule& from, const Capsule& to, float t) {
    return {glm::mix(from.a, to.a, t), glm::mix(from.b, to.b, t), to.radius};
}

float firstTouch(const Capsule& from, const Capsule& to, const Capsule& otherFrom, const Capsule& otherTo) {
    const glm::vec3 wayA = to.a - from.a, wayB = to.b - from.b;
    const glm::vec3 otherA = otherTo.a - otherFrom.a, otherB = otherTo.b - otherFrom.b;
    const float radii = to.radius + otherTo.radius;
    float t = 0;
    for (int i = 0; i < kAdvances; ++i) {
        const Nearest at = nearest(between(from, to, t), between(otherFrom, otherTo, t));
        const glm::vec3 apart = at.onSecond - at.onFirst;
        const float distance = glm::length(apart);
        const float gap = distance - radii;
        if (gap <= kTouchGap_m) return t;
        // Velocities are linear between a capsule's ends, so those of its ends bound them.
        const glm::vec3 n = apart / distance;
        const float closing = std::max(glm::dot(wayA, n), glm::dot(wayB, n)) -
                              std::min(glm::dot(otherA, n), glm::dot(otherB, n));
        if (!(closing > 0)) return 2;
        t += gap / closing;
        if (t > 1) return 2;
    }
    return t; // not converged: they graze, and almost touch
}

} // namespace shoal::physics
