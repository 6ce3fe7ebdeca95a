// Water between eye and object: what it takes of an object's light, and the veil of its own that it puts
// there instead. Free of OpenGL.
//
// I = J exp(-beta d) + B (1 - exp(-beta d)), for each channel: Schechner and Karpel 2005, "Recovery of
// Underwater Visibility and Structure by Polarization Analysis", with one beta for both terms; Akkaynak
// and Treibitz 2018, "A Revised Underwater Image Formation Model", say how far that carries (beta depends on
// distance and on the object; at the few metres of a dive by some tens of percent).
//
// Such mixing is linear in the light of the scene as the camera took it, and neither coded values nor the
// light that the inverse tone mapping makes of them are: that is about 1.8 times the coded value where things
// are not bright, far more where they are. So water works on display values, and on their squares, which are
// near enough to what sRGB's curve makes of them (and need no powers).
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
    // Of endless water, as the video would show it: squared coded values by direction, the sum of these times
    // veilTerms().
    std::array<glm::vec3, kVeilTerms> veil{};
    glm::vec3 attenuation_perM{0}; // beta, by red, green and blue; 0: no water

    bool none() const { return attenuation_perM.x + attenuation_perM.y + attenuation_perM.z < 1e-3f; }
};

// Squared coded values, 0 and above; dir: unit length, env frame.
inline glm::vec3 veilTowards(const Water& water, const glm::vec3& dir) {
    glm::vec3 sum(0);
    const auto terms = veilTerms(dir);
    for (size_t i = 0; i < kVeilTerms; ++i) sum += water.veil[i] * terms[i];
    return glm::max(sum, 0.0f);
}

// What an object `distance_m` away looks like that would have these display values (0 to 1) at hand.
inline glm::vec3 seenThrough(const Water& water, const glm::vec3& display, const glm::vec3& dir,
                             float distance_m) {
    const glm::vec3 left = glm::exp(-water.attenuation_perM * distance_m);
    return glm::sqrt(display * display * left + veilTowards(water, dir) * (1.0f - left));
}

} // namespace shoal::water
