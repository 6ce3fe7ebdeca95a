#include "tests/baselines/occlusion/BoneDistance.h"

#include <algorithm>
#include <cmath>

namespace shoal::occlusion::baselines {

namespace {

// Nearest point of a triangle. Ericson 2005, "Real-Time Collision Detection", 5.1.5.
glm::vec3 nearestOn(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / (d4 - d3 + d5 - d6));
    return a + (ab * vb + ac * vc) / (va + vb + vc);
}

} // namespace

float DistanceGrid::at(const glm::vec3& rest) const {
    const glm::vec3 inside = glm::clamp(rest, low, high);
    const glm::vec3 place = (inside - low) / (high - low) * glm::vec3(count - 1);
    const glm::ivec3 cell = glm::min(glm::ivec3(place), count - 2);
    const glm::vec3 part = place - glm::vec3(cell);
    const auto value = [&](int x, int y, int z) {
        return values[static_cast<size_t>(((cell.z + z) * count.y + cell.y + y) * count.x + cell.x + x)];
    };
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 by(k & 1, k >> 1 & 1, k >> 2);
        const glm::vec3 w = glm::mix(1.0f - part, part, glm::vec3(by));
        sum += w.x * w.y * w.z * value(by.x, by.y, by.z);
    }
    return sum + glm::distance(rest, inside);
}

std::vector<DistanceGrid> distanceGrids(const BodyMesh& rest, std::span<const int> boneOf, int bones,
                                        int cells) {
    std::vector<std::vector<glm::uvec3>> parts(static_cast<size_t>(bones));
    for (const glm::uvec3& corner : rest.triangles)
        parts[static_cast<size_t>(boneOf[corner.x])].push_back(corner);
    std::vector<DistanceGrid> grids;
    for (int bone = 0; bone < bones; ++bone) {
        const auto& part = parts[static_cast<size_t>(bone)];
        if (part.size() < 12) continue;
        DistanceGrid grid{.bone = bone, .low = glm::vec3(1e30f), .high = glm::vec3(-1e30f)};
        for (const glm::uvec3& corner : part)
            for (int i = 0; i < 3; ++i) {
                grid.low = glm::min(grid.low, rest.positions[corner[i]]);
                grid.high = glm::max(grid.high, rest.positions[corner[i]]);
            }
        const glm::vec3 extent = grid.high - grid.low;
        const float cell = std::max({extent.x, extent.y, extent.z}) / static_cast<float>(cells);
        grid.low -= cell;
        grid.high += cell;
        std::vector<glm::uvec3> near; // of the whole body
        for (const glm::uvec3& corner : rest.triangles) {
            const glm::vec3 at = rest.positions[corner.x];
            if (glm::clamp(at, grid.low, grid.high) == at) near.push_back(corner);
        }
        grid.count = glm::ivec3(glm::ceil((grid.high - grid.low) / cell)) + 1;
        for (int z = 0; z < grid.count.z; ++z)
            for (int y = 0; y < grid.count.y; ++y)
                for (int x = 0; x < grid.count.x; ++x) {
                    const glm::vec3 p =
                        glm::mix(grid.low, grid.high, glm::vec3(x, y, z) / glm::vec3(grid.count - 1));
                    // A part is open where the next one begins: what is inside, the whole body tells.
                    const auto squareTo = [&](const glm::uvec3& corner, glm::vec3& away) {
                        away = p - nearestOn(p, rest.positions[corner.x], rest.positions[corner.y],
                                             rest.positions[corner.z]);
                        return glm::dot(away, away);
                    };
                    float best = 1e30f, bestOfAll = 1e30f, sign = 1;
                    glm::vec3 away(0);
                    for (const glm::uvec3& corner : part) best = std::min(best, squareTo(corner, away));
                    for (const glm::uvec3& corner : near) {
                        const float square = squareTo(corner, away);
                        if (square >= bestOfAll) continue;
                        bestOfAll = square;
                        sign = glm::dot(away, rest.normals[corner.x] + rest.normals[corner.y] +
                                                  rest.normals[corner.z]);
                    }
                    grid.values.push_back(std::copysign(std::sqrt(best), sign));
                }
        grids.push_back(std::move(grid));
    }
    return grids;
}

float coneFree(std::span<const PlacedGrid> grids, const glm::vec3& origin, const glm::vec3& direction,
               float tangent, float nearest, float furthest) {
    float free = 1;
    float t = nearest;
    for (int step = 0; step < 24 && t < furthest; ++step) {
        const glm::vec3 at = origin + t * direction;
        float distance = 1e30f;
        for (const PlacedGrid& placed : grids) {
            const float sphere = glm::distance(at, placed.centre) - placed.radius;
            if (sphere >= distance) continue;
            distance =
                std::min(distance, sphere > placed.radius
                                       ? sphere
                                       : placed.grid->at(glm::vec3(placed.restFromWorld * glm::vec4(at, 1))));
        }
        // A half plane at this distance from the cone's axis leaves so much of it.
        free = std::min(free, std::clamp(0.5f + 0.5f * distance / (tangent * t), 0.0f, 1.0f));
        if (free <= 0.01f) return 0;
        t += std::max({distance, 0.5f * tangent * t, 0.25f * nearest});
    }
    return free;
}

} // namespace shoal::occlusion::baselines
