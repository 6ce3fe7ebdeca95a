#include "engine/render/FrameTiles.h"

#include "engine/math/LatLong.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {
constexpr float kMargin = 2; // texels that a layer's filter spreads an object by
} // namespace

// Its meridians are furthest from the middle one where they touch it: sin(longitude) = sin(angle) /
// cos(latitude); a cap that holds a pole touches all.
void FrameTiles::chooseCap(const glm::vec3& dirEnv, float halfAngle) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float angle = halfAngle + kMargin * kPi / static_cast<float>(frameSize_.y);
    const glm::vec2 uv = latLongFromDirection(dirEnv);
    const float latitude = (0.5f - uv.y) * kPi;
    const bool polar = std::abs(latitude) + angle >= kPi / 2;
    const float across = polar ? 0.5f : std::asin(std::sin(angle) / std::cos(latitude)) / (2 * kPi);
    const auto tile = [](float share, int tiles) {
        return static_cast<int>(std::floor(share * static_cast<float>(tiles)));
    };
    const int top = std::max(tile(uv.y - angle / kPi, kCount.y), 0);
    const int bottom = std::min(tile(uv.y + angle / kPi, kCount.y), kCount.y - 1);
    const int left = tile(uv.x - across, kCount.x);
    const int right = std::min(tile(uv.x + across, kCount.x), left + kCount.x - 1);
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) chosen_[indexOf(x, y)] = true;
}

void FrameTiles::choose(const glm::ivec2& frameSize, const glm::mat3& envFromWorld,
                        std::span<const scene::Sphere> spheres, const glm::vec3& eyeWorld) {
    frameSize_ = frameSize;
    chosen_.assign(kAll, false);
    for (const scene::Sphere& sphere : spheres) {
        const glm::vec3 away = sphere.centre - eyeWorld;
        const float distance = glm::length(away);
        // Around the eye: everywhere.
        const float halfAngle =
            distance > sphere.radius ? std::asin(sphere.radius / distance) : std::numbers::pi_v<float>;
        chooseCap(distance > 0 ? envFromWorld * (away / distance) : glm::vec3(0, 0, -1), halfAngle);
    }
}

} // namespace shoal::render
