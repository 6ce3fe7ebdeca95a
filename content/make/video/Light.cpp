#include "content/make/video/Light.h"

#include "content/make/video/Noise.h"

#include <algorithm>
#include <cmath>

namespace shoal::reef {

vec3 skyRadiance(const Scene& scene, const vec3& d) {
    const float up = std::max(d.y, 0.0f);
    vec3 sky = glm::mix(scene.sun.horizon, scene.sun.sky, std::sqrt(up));
    const vec2 roof = vec2(d.x, d.z) / (up + 0.18f);
    const float cloud =
        glm::smoothstep(0.02f, 0.34f, fractalNoise(vec3(roof.x * 1.1f, 3.7f, roof.y * 1.1f), 4));
    sky = glm::mix(sky, scene.sun.horizon * (2.1f / 1.35f), 0.6f * cloud * glm::smoothstep(0.02f, 0.2f, up));
    const float near = std::max(glm::dot(d, scene.sun.toSunAir), 0.0f);
    return sky + scene.sun.irradiance * (0.035f * std::pow(near, 24.0f) + 0.35f * std::pow(near, 380.0f));
}

// Fresnel's equations for unpolarised light; radiance grows by n^2 on its way into the water.
Window throughSurface(const vec3& dirWater, const vec3& normal) {
    const float cosWater = glm::dot(dirWater, normal);
    if (cosWater <= 0) return {};
    const float sin2Air = kWaterIndex * kWaterIndex * (1 - cosWater * cosWater);
    if (sin2Air >= 1) return {};
    const float cosAir = std::sqrt(1 - sin2Air);
    const float s = (kWaterIndex * cosWater - cosAir) / (kWaterIndex * cosWater + cosAir);
    const float p = (kWaterIndex * cosAir - cosWater) / (kWaterIndex * cosAir + cosWater);
    return {1 - 0.5f * (s * s + p * p), kWaterIndex * dirWater + (cosAir - kWaterIndex * cosWater) * normal};
}

vec3 sunAtDepth(const Scene& scene, float depth) {
    return scene.sun.irradiance * scene.water.transmittance(std::max(depth, 0.0f) / scene.sun.toSunWater.y);
}

} // namespace shoal::reef
