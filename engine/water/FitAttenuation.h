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

// What is believed before any floor is seen: that of clear coastal water, in which red goes soonest. Whether
// green or blue goes next is told by the veil: that of single scattering is b E / beta with b about equal for
// both, and E, the light from above, has been through the water too, so it goes with about 1 / beta^2. Its
// red tells nothing: that is what cameras' white balance makes up for.
glm::vec3 priorAttenuation(const glm::vec3& veilLin);

// Per metre, for each channel: the posterior mean of ln beta on a grid, with J and B solved for by least
// squares at each beta. samples: linear scene light of a floor of even albedo under even light; veilLin: at
// the horizon. Where the samples say little (none; floor as bright as veil; a scatter as large as what there
// is to see) this is the prior.
glm::vec3 fitAttenuation(std::span<const FloorSample> samples, const glm::vec3& veilLin);

} // namespace shoal::water
