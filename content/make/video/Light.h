// Light that falls into the water from above, and the picture of the sky that a level sea shows from below.
#pragma once

#include "content/make/video/Scene.h"

namespace shoal::reef {

// Returns the radiance of the sky without the sun's disc; the direction is in air.
vec3 skyRadiance(const Scene& scene, const vec3& dirAir);

// Refraction of a ray from the water up into the air: the share of light that the surface transmits, and the
// direction in air (unset if the share is 0).
struct Window {
    float through = 0;
    vec3 dirAir{0};
};
Window throughSurface(const vec3& dirWater, const vec3& normal);

// Irradiance of the sun on a plane that faces it at this depth (metres), under a level sea.
vec3 sunAtDepth(const Scene& scene, float depth);

} // namespace shoal::reef
