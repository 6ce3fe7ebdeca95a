#include "tests/bench/occlusion/Truth.h"
#include "engine/core/Random.h"

namespace shoal::bench {

namespace {

constexpr int kBounces = 4;
constexpr int kPaths = 48; // from each hit of a ray; so many because suns are small

// Light that a ray gets from a body that it hits: the source's cell, and the share of its radiance.
struct Path {
    size_t cell = 0;
    glm::vec3 left{0}; // 0: none comes
};

Path follow(const Scene& scene, const Rays& rays, const Cells& cells, glm::vec3 origin, glm::vec3 direction,
            Random& random) {
    Path path{0, glm::vec3(1)};
    for (int bounce = 0;; ++bounce) {
        const auto touch = rays.touch(origin, direction, scene.nearest);
        if (!touch) {
            path.cell = cells.cellTowards(direction);
            return path;
        }
        const Body& body = scene.bodies[touch->mesh];
        path.left *= body.sentBack;
        if (bounce == kBounces || path.left == glm::vec3(0)) return {};
        const Receiver there = receiverAt(scene, *touch);
        const glm::vec3 normal = glm::dot(there.normal, direction) > 0 ? -there.normal : there.normal;
        origin = origin + touch->distance * direction;
        // A point of the unit sphere that touches the surface gives a cosine-weighted direction.
        const float z = random.between(-1, 1), turn = random.between(0, 2 * std::numbers::pi_v<float>),
                    r = std::sqrt(1 - z * z);
        direction = glm::normalize(normal * 1.0001f + glm::vec3(r * std::cos(turn), r * std::sin(turn), z));
    }
}

} // namespace

OccludedLight occludedLight(const Scene& scene, const Rays& rays, std::span<const Receiver> receivers,
                            const Cells& cells) {
    using Sums = std::vector<glm::dvec3>; // by environment
    std::vector<Sums> halves[2];
    for (auto& half : halves) half.assign(receivers.size(), Sums(cells.environments, glm::dvec3(0)));
    OccludedLight light;
    light.open.resize(receivers.size());
    const bool bounces =
        std::ranges::any_of(scene.bodies, [](const Body& body) { return body.sentBack != glm::vec3(0); });
    onAllCores(receivers.size(), [&](size_t r) {
        const Receiver& at = receivers[r];
        Random random(r, 11);
        double free = 0, whole = 0;
        for (size_t c = 0; c < cells.cells.size(); ++c) {
            const Cell& cell = cells.cells[c];
            const float cosine = glm::dot(cell.centre, at.normal);
            if (cosine <= 0) continue;
            for (auto& half : halves) {
                const glm::vec2 place = cell.low + cell.side * glm::vec2(random.unit(), random.unit());
                const glm::vec3 direction = directionOfSquare(place);
                const bool seen = !rays.occluded(at.position, direction, scene.nearest);
                const double weight = cosine * cell.solidAngle;
                whole += weight;
                if (!seen) {
                    if (!bounces) continue;
                    for (int k = 0; k < kPaths; ++k) {
                        const Path path = follow(scene, rays, cells, at.position, direction, random);
                        const double share =
                            weight / (kPaths * static_cast<double>(cells.cells[path.cell].solidAngle));
                        const auto power = cells.of(path.cell);
                        for (size_t s = 0; s < power.size() && path.left != glm::vec3(0); ++s)
                            half[r][s] += share * glm::dvec3(path.left * power[s]);
                    }
                    continue;
                }
                free += weight;
                const auto power = cells.of(c);
                for (size_t s = 0; s < power.size(); ++s)
                    half[r][s] += static_cast<double>(cosine) * glm::dvec3(power[s]);
            }
        }
        light.open[r] = static_cast<float>(free / whole);
    });
    for (size_t s = 0; s < cells.environments; ++s) {
        std::vector<glm::dvec3> mean;
        double apart = 0, all = 0;
        for (size_t r = 0; r < receivers.size(); ++r) {
            mean.push_back((halves[0][r][s] + halves[1][r][s]) * (0.5 * std::numbers::inv_pi));
            const glm::dvec3 half = (halves[0][r][s] - halves[1][r][s]) * (0.5 * std::numbers::inv_pi);
            apart += glm::dot(half, half);
            all += glm::dot(mean.back(), mean.back());
        }
        light.diffuse.push_back(std::move(mean));
        light.noise.push_back(std::sqrt(apart / all));
    }
    return light;
}

} // namespace shoal::bench
