// How much of a surface's diffuse light a ball takes away, in closed form.
#pragma once

#include <glm/glm.hpp>

namespace shoal::occlusion::rivals {

// Share, 0 to 1, of the cosine-weighted hemisphere around `normal` that a ball covers, parts below the
// horizon left out. toBall: from the surface to its centre, longer than the radius. The form factor of Snyder
// 1996, "Area Light Sources for Real-Time Graphics", as Quilez, "Sphere ambient occlusion", writes it.
float ballOcclusion(const glm::vec3& normal, const glm::vec3& toBall, float radius);

} // namespace shoal::occlusion::rivals
