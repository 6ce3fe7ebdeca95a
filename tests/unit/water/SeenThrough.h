// The formulas of shaders/render/Water.glsl, to be compared with it.
#pragma once

#include "engine/water/Water.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace shoal::water {

// Returns the veil as squared coded values, 0 and above; dir: unit length, env frame.
inline glm::vec3 veilTowards(const Water& water, const glm::vec3& dir) {
    glm::vec3 sum(0);
    const auto terms = veilTerms(dir);
    for (size_t i = 0; i < kVeilTerms; ++i) sum += water.veil[i] * terms[i];
    return glm::max(sum, 0.0f);
}

// Returns the display values (0 to 1) of an object at `distance_m` that shows `display` without water.
inline glm::vec3 seenThrough(const Water& water, const glm::vec3& display, const glm::vec3& dir,
                             float distance_m) {
    const glm::vec3 transmitted = glm::exp(-water.attenuation_perM * distance_m);
    return glm::sqrt(display * display * transmitted + veilTowards(water, dir) * (1.0f - transmitted));
}

} // namespace shoal::water
