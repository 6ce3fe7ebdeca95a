#include "tests/baselines/occlusion/Baked.h"

#include <algorithm>
#include <cassert>

namespace shoal::occlusion::baselines {

std::vector<float> bakeAmbientOcclusion(const BodyMesh& mesh, const Occluded& occluded, int rays,
                                        float start) {
    constexpr float kBuried = 0.005f; // less than this is free: nobody sees it
    const auto directions = cosineDirections(rays);
    std::vector<float> sums(mesh.positions.size()), areas(mesh.positions.size());
    for (const glm::uvec3& corner : mesh.triangles) {
        const glm::vec3 a = mesh.positions[corner.x], b = mesh.positions[corner.y],
                        c = mesh.positions[corner.z];
        const float area = glm::length(glm::cross(b - a, c - a));
        for (int near = 0; near < 3; ++near) {
            glm::vec3 weights(1 / 6.0f);
            weights[near] = 4 / 6.0f;
            const glm::vec3 normal =
                glm::normalize(weights.x * mesh.normals[corner.x] + weights.y * mesh.normals[corner.y] +
                               weights.z * mesh.normals[corner.z]);
            const glm::mat3 frame = frameAround(normal);
            // Out to where the smooth surface would be: Hanika 2021, "Hacking the Shadow Terminator".
            const glm::vec3 flat = weights.x * a + weights.y * b + weights.z * c;
            glm::vec3 origin = flat + start * normal;
            for (int i = 0; i < 3; ++i) {
                const glm::vec3& n = mesh.normals[corner[i]];
                origin -= weights[i] * std::min(0.0f, glm::dot(flat - mesh.positions[corner[i]], n)) * n;
            }
            int seen = 0;
            for (const glm::vec3& direction : directions) seen += !occluded(origin, frame * direction);
            const float free = static_cast<float>(seen) / static_cast<float>(rays);
            if (free < kBuried) continue;
            sums[corner[near]] += area * free;
            areas[corner[near]] += area;
        }
    }
    for (size_t i = 0; i < sums.size(); ++i) sums[i] = areas[i] > 0 ? sums[i] / areas[i] : 1;
    return sums;
}

glm::vec3 Transfer::radiance(size_t vertex, const math::ShRgb& environment) const {
    const auto n = static_cast<size_t>(count());
    glm::vec3 sum(0);
    for (size_t i = 0; i < n; ++i) sum += terms[vertex * n + i] * glm::vec3(environment[i]);
    return sum;
}

// The mean over cosine-weighted rays of Y_lm where nothing is met: their density is cosine / pi.
Transfer bakeTransfer(const BodyMesh& mesh, const Occluded& occluded, int bands, int rays, float start) {
    assert(bands >= 1 && bands <= math::kShBands);
    Transfer transfer{bands, {}};
    const auto directions = cosineDirections(rays);
    const auto n = static_cast<size_t>(transfer.count());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::mat3 frame = frameAround(mesh.normals[i]);
        const glm::vec3 origin = mesh.positions[i] + start * mesh.normals[i];
        math::ShBasis sum{};
        for (const glm::vec3& local : directions) {
            const glm::vec3 direction = frame * local;
            if (occluded(origin, direction)) continue;
            const math::ShBasis basis = math::shBasis(direction);
            for (size_t k = 0; k < n; ++k) sum[k] += basis[k];
        }
        for (size_t k = 0; k < n; ++k) transfer.terms.push_back(static_cast<float>(sum[k] / rays));
    }
    return transfer;
}

} // namespace shoal::occlusion::baselines
