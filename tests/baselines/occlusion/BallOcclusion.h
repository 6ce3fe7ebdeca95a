// How much of a surface's diffuse light a sphere takes away, in closed form.
#pragma once

#include <glm/glm.hpp>

namespace shoal::occlusion::baselines {

// Share, 0 to 1, of the cosine-weighted hemisphere around `normal` that a sphere covers, parts below the
// horizon left out. toSphere: from the surface to its centre, longer than the radius. The form factor of
// Snyder 1996, "Area Light Sources for Real-Time Graphics", as Quilez, "Sphere ambient occlusion", writes it.
float sphereOcclusion(const glm::vec3& normal, const glm::vec3& toSphere, float radius);

} // namespace shoal::occlusion::baselines
