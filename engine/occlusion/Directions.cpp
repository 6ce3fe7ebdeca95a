#include "engine/occlusion/Directions.h"

#include <algorithm>
#include <cassert>

namespace shoal::occlusion {

Axes::Axes(int count) {
    assert(count >= 0 && count <= 65536);
    if (count == 0) return;
    for (int i = 0; i < count; ++i) {
        const double z = (i + 0.5) / count, r = std::sqrt(1 - z * z);
        axes.emplace_back(r * std::cos(kGoldenAngle * i), r * std::sin(kGoldenAngle * i), z);
    }
    table.resize(kTableWidth * kTableWidth);
    for (size_t c = 0; c < table.size(); ++c) {
        const glm::vec2 place(static_cast<float>(c % kTableWidth) + 0.5f,
                              static_cast<float>(c / kTableWidth) + 0.5f);
        const glm::vec2 square = place * (2.0f / kTableWidth) - 1.0f;
        const glm::vec2 flat = glm::vec2(square.x + square.y, square.x - square.y) / 2.0f;
        const glm::vec3 middle = glm::normalize(glm::vec3(flat, 1.0f - std::abs(flat.x) - std::abs(flat.y)));
        const auto nearest = std::ranges::max_element(
            axes, {}, [&](const glm::vec3& axis) { return std::abs(glm::dot(axis, middle)); });
        table[c] = static_cast<uint16_t>(nearest - axes.begin());
    }
}

glm::mat3 frameAround(const glm::vec3& n) {
    const float sign = n.z < 0 ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

glm::mat3 lookingAlong(const glm::vec3& axis, float turn) {
    const glm::mat3 frame = frameAround(axis);
    const float c = std::cos(turn), d = std::sin(turn);
    return glm::transpose(glm::mat3(c * frame[0] + d * frame[1], c * frame[1] - d * frame[0], axis));
}

} // namespace shoal::occlusion
