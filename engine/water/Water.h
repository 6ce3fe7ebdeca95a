// Water between eye and object: what it takes of an object's light, and the veil of its own that it puts
// there instead. Free of OpenGL.
//
// I = J exp(-beta d) + B (1 - exp(-beta d)), for each channel: Schechner and Karpel 2005, "Recovery of
// Underwater Visibility and Structure by Polarization Analysis", eq. 5 with one beta for both terms; Akkaynak
// and Treibitz 2018, "A Revised Underwater Image Formation Model", say how far that carries (beta depends on
// distance and on the object; at the few metres of a dive by some tens of percent).
//
// Such mixing is linear in the scene's light. The light that the inverse tone mapping makes of a video is
// not: below its highlights it is 1.8 times the coded value (InverseToneMap.h), which is about the root of
// the scene's light. So water mixes squares of radiance: "squared radiance" below.
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>

namespace shoal::water {

// The real spherical harmonics of bands 0 to 2, but for their constant factors. Twin of
// shaders/render/Water.glsl.
constexpr size_t kVeilTerms = 9;
inline std::array<float, kVeilTerms> veilTerms(const glm::vec3& dir) {
    return {1,
            dir.x,
            dir.y,
            dir.z,
            dir.x * dir.y,
            dir.y * dir.z,
            dir.x * dir.z,
            dir.y * dir.y - 1 / 3.0f,
            dir.x * dir.x - dir.z * dir.z};
}

struct Water {
    // Squared radiance of the veil before endless water, by direction: the sum of these times veilTerms().
    std::array<glm::vec3, kVeilTerms> veil{};
    glm::vec3 attenuation_perM{0}; // beta, by red, green and blue; 0: no water

    bool none() const { return attenuation_perM.x + attenuation_perM.y + attenuation_perM.z < 1e-3f; }
};

// Squared radiance; dir: unit length, env frame.
inline glm::vec3 veilTowards(const Water& water, const glm::vec3& dir) {
    glm::vec3 sum(0);
    const auto terms = veilTerms(dir);
    for (size_t i = 0; i < kVeilTerms; ++i) sum += water.veil[i] * terms[i];
    return glm::max(sum, 0.0f);
}

// The radiance that arrives of an object `distance_m` away.
inline glm::vec3 seenThrough(const Water& water, const glm::vec3& radiance, const glm::vec3& dir,
                             float distance_m) {
    const glm::vec3 left = glm::exp(-water.attenuation_perM * distance_m);
    return glm::sqrt(radiance * radiance * left + veilTowards(water, dir) * (1.0f - left));
}

} // namespace shoal::water
