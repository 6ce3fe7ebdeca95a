#include "engine/occlusion/Folds.h"

#include "engine/occlusion/Bvh.h"
#include "engine/occlusion/Directions.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

namespace shoal::occlusion {

namespace {

constexpr float kGap = 1e-4f; // of a ray's start from its surface, of the body's extent

} // namespace

std::vector<glm::vec4> findFolds(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                 std::span<const uint32_t> indices, int rays) {
    std::vector<glm::vec4> folds(positions.size(), glm::vec4(0));
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
    const float gap = kGap * glm::distance(low, high);
    if (!(gap > 0) || !std::isfinite(gap) || rays < 1) return folds;
    const std::vector<glm::vec3> pattern = cosineDirections(rays);
    const Bvh bvh(positions, indices);
    const auto work = [&](size_t from, size_t to) {
        for (size_t v = from; v < to; ++v) {
            const glm::mat3 frame = frameAround(normals[v]);
            glm::vec4 sum(0);
            for (const glm::vec3& each : pattern) {
                const glm::vec3 direction = frame * each;
                if (bvh.blocked(positions[v] + gap * normals[v], direction, 0, INFINITY))
                    sum += glm::vec4(direction, 1);
            }
            folds[v] = sum / static_cast<float>(rays);
        }
    };
    const size_t threads = std::clamp<size_t>(std::thread::hardware_concurrency(), 1, 8);
    std::vector<std::jthread> helpers;
    for (size_t t = 1; t < threads; ++t)
        helpers.emplace_back(work, positions.size() * t / threads, positions.size() * (t + 1) / threads);
    work(0, positions.size() / threads);
    return folds;
}

} // namespace shoal::occlusion
