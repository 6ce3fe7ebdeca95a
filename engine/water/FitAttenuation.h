// How strongly water attenuates, from the light of a level floor that vanishes in the distance.
#pragma once

#include <glm/vec3.hpp>

#include <span>

namespace shoal::water {

// The floor in one direction below the horizon.
struct FloorSample {
    float distance_m = 0;
    float weight = 0; // relative to the others
    glm::vec3 lightLin{0};
};

// Bounds of any attenuation found here, per metre: clearest ocean in blue, and turbid coast in red (Jerlov
// 1976, "Marine Optics", types I to 9; as inherent properties: Solonenko and Mobley 2015, "Inherent optical
// properties of Jerlov water types").
constexpr float kLeastAttenuation_perM = 0.015f, kMostAttenuation_perM = 1.5f;

// What is believed before any floor is seen: the channels' geometric mean is that of clear coastal water, and
// their ratio follows from the veil's colour. The veil of single scattering is b E / beta with b about equal
// for all, and E, the light from above, has itself been through the water: so B goes with a power of 1 / beta
// above 1; 2 is what a path as long again from the surface makes of it.
glm::vec3 priorAttenuation(const glm::vec3& veilLin);

// Per metre, for each channel: the posterior mean of ln beta on a grid, with J and B solved for by least
// squares at each beta. samples: linear scene light of a floor of even albedo under even light; veilLin: at
// the horizon. Where the samples say little (none; floor as bright as veil; a scatter as large as what there
// is to see) this is the prior.
glm::vec3 fitAttenuation(std::span<const FloorSample> samples, const glm::vec3& veilLin);

} // namespace shoal::water
