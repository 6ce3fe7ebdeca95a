#include "engine/occlusion/BodyMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace shoal::occlusion {

// A triangle without area adds the same edges to both lists.
bool isClosed(const BodyMesh& mesh) {
    std::vector<std::array<float, 6>> there, back; // edges: the positions of both ends
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 &a = mesh.positions[t[k]], &b = mesh.positions[t[(k + 1) % 3]];
            there.push_back({a.x, a.y, a.z, b.x, b.y, b.z});
            back.push_back({b.x, b.y, b.z, a.x, a.y, a.z});
        }
    std::ranges::sort(there);
    std::ranges::sort(back);
    return !there.empty() && there == back;
}

Sphere boundingSphere(const BodyMesh& mesh) {
    if (mesh.triangles.empty()) return {};
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, mesh.positions[t[k]]);
            high = glm::max(high, mesh.positions[t[k]]);
        }
    Sphere sphere{low + (high - low) / 2.0f, 0};
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, mesh.positions[t[k]]));
    return sphere;
}

} // namespace shoal::occlusion
