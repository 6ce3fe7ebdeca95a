#include "engine/occlusion/EllipsoidOcclusion.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::occlusion {

namespace {

// Sine of the angle in which a cap has an end's share of the sphere.
const float kCellSine = std::sqrt(1 - (1 - 1.0f / kAxisCount) * (1 - 1.0f / kAxisCount));
constexpr float kMeanBack = -2 / 3.0f; // of directions in a cosine-weighted hemisphere, along its normal

float sideOf(const glm::vec3& normal, size_t axis) {
    return glm::dot(normal, kAxes[axis]) < 0 ? -1.0f : 1.0f;
}

} // namespace

EllipsoidSilhouette::EllipsoidSilhouette(const Ellipsoid& shape, const glm::vec3& p) {
    glm::mat3 scaled = shape.worldFromAxes;
    for (int k = 0; k < 3; ++k) scaled[k] /= shape.semiAxes[k];
    matrix_ = scaled * glm::transpose(scaled);
    const glm::vec3 m = p - shape.centre;
    slope_ = matrix_ * m;
    const float square = std::max(glm::dot(m, slope_), 1e-6f), far2 = std::max(glm::dot(m, m), 1e-12f),
                outside = std::max(square, 1.0f); // a point within counts as on the skin
    edge_ = std::sqrt(outside - 1);
    const glm::vec3& a = shape.semiAxes;
    const float disc2 = a.x * a.y * a.z * std::sqrt(square / far2);
    width_ =
        std::sqrt(1 / (outside * std::max(glm::dot(slope_, slope_), 1e-12f)) + (1 - 1 / outside) * disc2);
    const float near2 = 1 / (outside * outside); // from near it is no disc
    cap_ = 0.5f - 0.5f * std::sqrt(1 - std::min(std::max(disc2 / far2, near2 * near2), 1.0f));
}

float EllipsoidSilhouette::hides(const glm::vec3& direction, float sine, float share) const {
    const float extent = std::sqrt(glm::dot(direction, matrix_ * direction));
    const float past = glm::dot(slope_, direction) + edge_ * extent;
    return glm::clamp(0.5f - 0.5f / sine * width_ * past, 0.0f, 1.0f) * std::min(cap_ / share, 1.0f);
}

void addOcclusion(const EllipsoidSilhouette& silhouette, float strength, const glm::vec3& normal,
                  AxisOcclusion& hidden) {
    for (size_t k = 0; k < kAxisCount; ++k)
        hidden[k] += (1 - hidden[k]) * strength *
                     silhouette.hides(sideOf(normal, k) * kAxes[k], kCellSine, 0.5f / kAxisCount);
}

AxisOcclusion axisOcclusion(const glm::vec3& p, const glm::vec3& normal,
                            std::span<const Occluder> occluders) {
    AxisOcclusion hidden{};
    for (const Occluder& occluder : occluders)
        addOcclusion(EllipsoidSilhouette(occluder.shape, p), occluder.strength, normal, hidden);
    return hidden;
}

AxisOcclusion withSelfOcclusion(AxisOcclusion hidden, const glm::vec3& normal,
                                const glm::vec4& selfOcclusion) {
    for (size_t k = 0; k < kAxisCount; ++k)
        hidden[k] = glm::clamp(hidden[k] + selfOcclusionAlong(selfOcclusion, sideOf(normal, k) * kAxes[k]),
                               0.0f, 1.0f);
    return hidden;
}

glm::vec4 occlusionMoments(const AxisOcclusion& hidden, const glm::vec3& normal) {
    glm::vec4 sum(0);
    float all = 0;
    for (size_t k = 0; k < kAxisCount; ++k) {
        const float along = glm::dot(normal, kAxes[k]);
        all += std::abs(along);
        sum += hidden[k] * glm::vec4(along * kAxes[k], std::abs(along));
    }
    return sum / all;
}

// What is amiss is added as if nothing were clamped, again and again. Across the normal the variance of a
// cosine-weighted hemisphere is a quarter.
glm::vec4 fitSelfOcclusion(const AxisOcclusion& hidden, const glm::vec3& normal, const glm::vec4& moments) {
    constexpr int kSteps = 8;
    constexpr float kMin = 0.05f; // of the hemisphere: less is as good as none
    const float byOthers = std::min(occlusionMoments(hidden, normal).w / std::max(moments.w, kMin), 1.0f);
    const glm::vec3 middle = -kMeanBack * normal;
    glm::vec4 selfOcclusion(0);
    for (int step = 0; step < kSteps; ++step) {
        const glm::vec4 amiss =
            moments - occlusionMoments(withSelfOcclusion(hidden, normal, selfOcclusion), normal);
        glm::vec3 slope = 4.0f * (glm::vec3(amiss) - amiss.w * middle);
        slope -= byOthers * byOthers * glm::dot(slope, normal) * normal;
        selfOcclusion += glm::vec4(slope, amiss.w - glm::dot(slope, middle));
    }
    return selfOcclusion;
}

} // namespace shoal::occlusion
