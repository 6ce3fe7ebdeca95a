#include "tests/baselines/occlusion/Transfer.h"

#include <cassert>

namespace shoal::occlusion::baselines {

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
