#include "content/make/models/occlusion/Silhouettes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::occlusion {

namespace {

// Sine of the half angle of a cap with an end's share of the sphere.
const float kCellSine = std::sqrt(1 - (1 - 1.0f / kAxisCount) * (1 - 1.0f / kAxisCount));

} // namespace

EllipsoidSilhouette::EllipsoidSilhouette(const Ellipsoid& shape, const glm::vec3& p) {
    glm::mat3 scaled = shape.worldFromAxes;
    for (int k = 0; k < 3; ++k) scaled[k] /= shape.semiAxes[k];
    matrix_ = scaled * glm::transpose(scaled);
    const glm::vec3 m = p - shape.centre;
    slope_ = matrix_ * m;
    const float square = std::max(glm::dot(m, slope_), 1e-6f), far2 = std::max(glm::dot(m, m), 1e-12f),
                outside = std::max(square, 1.0f); // a point inside counts as on the skin
    edge_ = std::sqrt(outside - 1);
    const glm::vec3& a = shape.semiAxes;
    const float disc2 = a.x * a.y * a.z * std::sqrt(square / far2);
    width_ =
        std::sqrt(1 / (outside * std::max(glm::dot(slope_, slope_), 1e-12f)) + (1 - 1 / outside) * disc2);
    const float near2 = 1 / (outside * outside); // near the surface its shadow is no disc
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
        hidden[k] +=
            (1 - hidden[k]) * strength * silhouette.hides(axisAbove(normal, k), kCellSine, 0.5f / kAxisCount);
}

AxisOcclusion axisOcclusion(const glm::vec3& p, const glm::vec3& normal,
                            std::span<const Occluder> occluders) {
    AxisOcclusion hidden{};
    for (const Occluder& occluder : occluders)
        addOcclusion(EllipsoidSilhouette(occluder.shape, p), occluder.strength, normal, hidden);
    return hidden;
}

void completeOwn(const SelfOccludingMesh& mesh, std::span<const Occluder> own,
                 std::span<glm::vec4> selfOcclusion) {
    std::vector<bool> used(selfOcclusion.size(), false);
    for (const uint32_t corner : mesh.indices) used[corner] = true;
    for (size_t v = 0; v < selfOcclusion.size(); ++v) {
        if (!used[v]) continue;
        const glm::vec3& normal = mesh.normals[v];
        // Few rays may give shares outside of 0 to 1, which withSelfOcclusion() clamps.
        const glm::vec4 moments = occlusionMoments(withSelfOcclusion({}, normal, selfOcclusion[v]), normal);
        selfOcclusion[v] = fitSelfOcclusion(axisOcclusion(mesh.positions[v], normal, own), normal, moments);
    }
}

} // namespace shoal::occlusion
