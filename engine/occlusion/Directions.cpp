#include "engine/occlusion/Directions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shoal::occlusion {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Half of the octahedron, turned by 45 degrees to fill [-1, 1]^2. direction.z >= 0.
glm::vec2 squareFromHalf(const glm::vec3& direction) {
    const glm::vec2 flat =
        glm::vec2(direction) / (std::abs(direction.x) + std::abs(direction.y) + direction.z);
    return {flat.x + flat.y, flat.x - flat.y};
}

glm::vec3 halfFromSquare(const glm::vec2& square) {
    const glm::vec2 flat = glm::vec2(square.x + square.y, square.x - square.y) / 2.0f;
    return glm::normalize(glm::vec3(flat, 1.0f - std::abs(flat.x) - std::abs(flat.y)));
}

} // namespace

std::vector<glm::vec3> cubeDirections(int n) {
    std::vector<glm::vec3> directions;
    directions.reserve(static_cast<size_t>(6 * n * n));
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const auto across = [&](int i) {
                    return std::tan(kPi / 4 * ((2 * static_cast<float>(i) + 1) / static_cast<float>(n) - 1));
                };
                glm::vec3 v;
                v[face / 2] = face % 2 ? -1.0f : 1.0f;
                v[(face / 2 + 1) % 3] = across(x);
                v[(face / 2 + 2) % 3] = across(y);
                directions.push_back(glm::normalize(v));
            }
    return directions;
}

int nearestCubeDirection(const glm::vec3& direction, int n) {
    const glm::vec3 a = glm::abs(direction);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const auto cell = [&](float across) {
        const float place = (std::atan(across / a[axis]) * 4 / kPi + 1) / 2 * static_cast<float>(n);
        return std::clamp(static_cast<int>(place), 0, n - 1);
    };
    const int face = 2 * axis + (direction[axis] < 0);
    return (face * n + cell(direction[(axis + 2) % 3])) * n + cell(direction[(axis + 1) % 3]);
}

Axes::Axes(int count) {
    assert(count >= 0 && count <= 65536);
    if (count == 0) return;
    for (int i = 0; i < count; ++i) {
        const double z = (i + 0.5) / count, r = std::sqrt(1 - z * z);
        axes_.emplace_back(r * std::cos(kGoldenAngle * i), r * std::sin(kGoldenAngle * i), z);
    }
    table_.resize(kTableWidth * kTableWidth);
    for (size_t c = 0; c < table_.size(); ++c) {
        const glm::vec2 place(static_cast<float>(c % kTableWidth) + 0.5f,
                              static_cast<float>(c / kTableWidth) + 0.5f);
        const glm::vec3 middle = halfFromSquare(place * (2.0f / kTableWidth) - 1.0f);
        const auto nearest = std::max_element(axes_.begin(), axes_.end(), [&](const auto& p, const auto& q) {
            return std::abs(glm::dot(p, middle)) < std::abs(glm::dot(q, middle));
        });
        table_[c] = static_cast<uint16_t>(nearest - axes_.begin());
    }
}

size_t Axes::cell(glm::vec3 direction) {
    if (direction.z < 0) direction = -direction;
    const glm::vec2 place = (squareFromHalf(direction) * 0.5f + 0.5f) * static_cast<float>(kTableWidth);
    const int x = std::clamp(static_cast<int>(place.x), 0, kTableWidth - 1);
    const int y = std::clamp(static_cast<int>(place.y), 0, kTableWidth - 1);
    return static_cast<size_t>(y * kTableWidth + x);
}

std::vector<glm::vec3> cosineDirections(int count) {
    std::vector<glm::vec3> out;
    for (int i = 0; i < count; ++i) {
        const float square =
            (static_cast<float>(i) + 0.5f) / static_cast<float>(count); // of the disc's radius
        const float ring = std::sqrt(square);
        out.emplace_back(ring * static_cast<float>(std::cos(i * kGoldenAngle)),
                         ring * static_cast<float>(std::sin(i * kGoldenAngle)), std::sqrt(1 - square));
    }
    return out;
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
