// Bayesian fit of the water's attenuation to the light of a level floor at growing distances.
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
constexpr float kMinAttenuation_perM = 0.015f, kMaxAttenuation_perM = 1.5f;

// Prior: that of clear coastal water, with red attenuated most. The ratio of green to blue follows from the
// veil: under single scattering it is b E / beta with b about equal for both, and E, the light from above,
// has passed through the water too, so it is proportional to about 1 / beta^2. Its red is not used, because
// cameras' white balance compensates for it.
glm::vec3 priorAttenuation(const glm::vec3& veilLin);

// Per metre, for each channel: the posterior mean of ln beta on a grid, with J and B solved for by least
// squares at each beta. samples: linear scene light of a floor of uniform albedo and illumination; veilLin:
// at the horizon. Where the samples are uninformative (none; floor as bright as veil; large scatter) this is
// the prior.
glm::vec3 fitAttenuation(std::span<const FloorSample> samples, const glm::vec3& veilLin);

} // namespace shoal::water
