// Synthetic spaces of films, for tests. They use only arithmetic and roots: equal on every machine.
#pragma once

#include "game/rules/FilmSpace.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace shoal::game {

// distance_m: float(glm::vec3 dir, double time_s), positive.
template <class Distance>
std::shared_ptr<const FilmSpace> madeSpace(double length_s, int steps, const Distance& distance_m) {
    std::vector<uint16_t> surface_mm;
    for (int step = 0; step < steps; ++step)
        for (int cell = 0; cell < FilmSpace::kCells; ++cell)
            surface_mm.push_back(static_cast<uint16_t>(
                1000 * std::min(distance_m(FilmSpace::directionOf(cell), step * length_s / steps),
                                FilmSpace::kFar_m)));
    return std::make_shared<const FilmSpace>(length_s, std::move(surface_mm));
}

// Returns the distance from the middle of a tunnel along Z to its wall.
inline float toTunnel_m(glm::vec3 dir, float radius_m) {
    return radius_m / std::max(glm::length(glm::vec2(dir)), 1e-3f);
}

} // namespace shoal::game
