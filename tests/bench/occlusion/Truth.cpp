#include "tests/bench/occlusion/Truth.h"

#include "engine/core/Random.h"

#include <atomic>
#include <numbers>
#include <thread>

namespace shoal::bench {

void onAllCores(size_t count, const std::function<void(size_t)>& job) {
    std::atomic<size_t> next{0};
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back([&] {
            for (size_t k; (k = next++) < count;) job(k);
        });
    for (std::thread& thread : threads) thread.join();
}

OccludedLight occludedLight(const Scene& scene, const Rays& rays, std::span<const Receiver> receivers,
                            const Cells& cells) {
    using Sums = std::vector<glm::dvec3>; // by surround
    std::vector<Sums> halves[2];
    for (auto& half : halves) half.assign(receivers.size(), Sums(cells.surrounds, glm::dvec3(0)));
    OccludedLight light;
    light.open.resize(receivers.size());
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
                const bool seen = !rays.occluded(at.position, directionOfSquare(place), scene.nearest);
                const double weight = static_cast<double>(cosine * cell.solidAngle);
                whole += weight;
                if (!seen) continue;
                free += weight;
                const auto power = cells.of(c);
                for (size_t s = 0; s < power.size(); ++s)
                    half[r][s] += static_cast<double>(cosine) * glm::dvec3(power[s]);
            }
        }
        light.open[r] = static_cast<float>(free / whole);
    });
    for (size_t s = 0; s < cells.surrounds; ++s) {
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
