// The cells of a grid that a ray crosses, in its order. Amanatides and Woo 1987, "A Fast Voxel Traversal
// Algorithm for Ray Tracing".
#pragma once

#include <cmath>
#include <limits>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// Shrinks [from, to] to where low <= origin + t * direction <= high; false if nothing is left.
inline bool clipSlab(float origin, float direction, float low, float high, float& from, float& to) {
    if (direction == 0) return origin >= low && origin <= high && from <= to;
    const float a = (low - origin) / direction, b = (high - origin) / direction;
    from = glm::max(from, glm::min(a, b));
    to = glm::min(to, glm::max(a, b));
    return from <= to;
}

// Calls visit(cell, from, to) for the unit cells with low <= cell < high along the ray between t = from and
// to, until it returns true; whether it did.
template <class Visit>
bool walkCells(const glm::vec2& origin, const glm::vec2& direction, float from, float to,
               const glm::ivec2& low, const glm::ivec2& high, Visit&& visit) {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    const glm::ivec2 step(direction.x < 0 ? -1 : 1, direction.y < 0 ? -1 : 1);
    glm::ivec2 cell = glm::clamp(glm::ivec2(glm::floor(origin + direction * from)), low, high - 1);
    glm::vec2 next, perCell;
    for (int k = 0; k < 2; ++k) {
        perCell[k] = direction[k] == 0 ? kNever : 1 / std::abs(direction[k]);
        next[k] = direction[k] == 0
                      ? kNever
                      : (static_cast<float>(cell[k] + (step[k] > 0)) - origin[k]) / direction[k];
    }
    for (float t = from;;) {
        const int k = next.x < next.y ? 0 : 1;
        const float end = glm::min(next[k], to);
        if (visit(cell, t, glm::max(t, end))) return true;
        if (next[k] >= to) return false;
        t = glm::max(t, end);
        cell[k] += step[k];
        next[k] += perCell[k];
        if (cell[k] < low[k] || cell[k] >= high[k]) return false;
    }
}

} // namespace shoal::occlusion
