// Angles between directions, for tests.
#pragma once

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::light {

// Returns the angle between unit vectors; exact where they are close, too.
inline double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(2 * std::asin(std::min(1.0, 0.5 * glm::length(a - b))));
}

} // namespace shoal::light
