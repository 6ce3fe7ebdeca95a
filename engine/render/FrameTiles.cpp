#include "engine/render/FrameTiles.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {
constexpr float kMargin = 2; // texels by which a layer's filter spreads an object
} // namespace

void FrameTiles::clear(const glm::ivec2& frameSize) {
    frameSize_ = frameSize;
    chosen_.assign(kAll, false);
}

CellRange FrameTiles::cellsOf(const glm::vec3& centreEnv, float radius) const {
    const float distance = glm::length(centreEnv);
    // A sphere around the camera covers every tile.
    const float halfAngle = distance > radius ? std::asin(radius / distance) : std::numbers::pi_v<float>;
    const float margin = kMargin * std::numbers::pi_v<float> / static_cast<float>(frameSize_.y);
    return cellsOfCap(kCount, distance > 0 ? centreEnv / distance : glm::vec3(0, 0, -1), halfAngle + margin);
}

void FrameTiles::choose(const glm::ivec2& frameSize, const glm::mat3& envFromWorld,
                        std::span<const scene::Sphere> spheres, const glm::vec3& eyeWorld) {
    clear(frameSize);
    for (const scene::Sphere& sphere : spheres)
        eachOfSphere(envFromWorld * (sphere.centre - eyeWorld), sphere.radius,
                     [&](const glm::ivec2& tile) { choose(tile); });
}

} // namespace shoal::render
