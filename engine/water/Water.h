// Model of the water between eye and object: attenuation of the object's light, and the veil (backscatter)
// that is added. Twin of shaders/render/Water.glsl; free of OpenGL.
//
// I = J exp(-beta d) + B (1 - exp(-beta d)), for each channel: Schechner and Karpel 2005, "Recovery of
// Underwater Visibility and Structure by Polarization Analysis", with one beta for both terms; its limits:
// Akkaynak and Treibitz 2018, "A Revised Underwater Image Formation Model" (beta depends on distance and
// object, at the few metres of a dive by some tens of percent).
//
// The equation is linear in the scene's light. Neither coded values nor the radiance after inverse tone
// mapping are (the latter is about 1.8 times the coded value where that is low, far more where it is high).
// So water works on the squares of display values, which approximate the sRGB curve without powers.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace shoal::water {

// Returns the real spherical harmonics of bands 0 to 2 without their constant factors. Twin of
// shaders/render/Water.glsl.
constexpr size_t kVeilTerms = 9;
inline std::array<float, kVeilTerms> veilTerms(const glm::vec3& dir) {
    const glm::vec3 square = dir * dir, mixed = dir * glm::vec3(dir.y, dir.z, dir.x); // xy, yz, zx
    return {1, dir.x, dir.y, dir.z, mixed.x, mixed.y, mixed.z, square.y - 1 / 3.0f, square.x - square.z};
}

struct Water {
    // Light of infinitely deep water: coefficients of veilTerms(), in squared coded values by direction.
    std::array<glm::vec3, kVeilTerms> veil{};
    glm::vec3 attenuation_perM{0}; // beta, by red, green and blue; 0: no water

    bool none() const { return attenuation_perM.x + attenuation_perM.y + attenuation_perM.z < 1e-3f; }
};

} // namespace shoal::water
