#include "engine/occlusion/BodyMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

namespace shoal::occlusion {

namespace {

// Returns for each position the index of one representative of all equal positions.
std::vector<uint32_t> weld(std::span<const glm::vec3> positions) {
    std::vector<uint32_t> order(positions.size()), place(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (size_t i = 0; i < order.size(); ++i)
        place[order[i]] = i && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
    return place;
}

} // namespace

bool isClosed(const BodyMesh& mesh) {
    const std::vector<uint32_t> place = weld(mesh.positions);
    std::vector<std::array<uint32_t, 2>> there, back;
    for (const glm::uvec3& t : mesh.triangles) {
        const std::array<uint32_t, 3> v{place[t.x], place[t.y], place[t.z]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue; // a triangle without area has no boundary
        for (size_t k = 0; k < 3; ++k) {
            there.push_back({v[k], v[(k + 1) % 3]});
            back.push_back({v[(k + 1) % 3], v[k]});
        }
    }
    std::sort(there.begin(), there.end());
    std::sort(back.begin(), back.end());
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
