#include "engine/render/FrameTiles.h"

#include "engine/math/LatLongCap.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {
constexpr float kMargin = 2; // texels that a layer's filter spreads an object by
} // namespace

void FrameTiles::chooseCap(const glm::vec3& dirEnv, float halfAngle) {
    const float margin = kMargin * std::numbers::pi_v<float> / static_cast<float>(frameSize_.y);
    const CellRange range = cellsOfCap(kCount, dirEnv, halfAngle + margin);
    for (int y = range.first.y; y <= range.last.y; ++y)
        for (int x = range.first.x; x <= range.last.x; ++x) chosen_[indexOf(x, y)] = true;
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
