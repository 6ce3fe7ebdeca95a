#include "tests/bench/occlusion/Shapes.h"

#include <algorithm>
#include <cmath>

namespace shoal::bench {

namespace {

using glm::vec2;
using glm::vec3;

// Distances, exact or nearly so. Quilez, "Distance functions".

float ellipsoid(const vec3& p, const vec3& centre, const vec3& radii) {
    const float k0 = glm::length((p - centre) / radii);
    const float k1 = glm::length((p - centre) / (radii * radii));
    return k0 * (k0 - 1) / std::max(k1, 1e-6f);
}

// Round cone by interpolated radius.
float limb(const vec3& p, const vec3& a, const vec3& b, float radiusA, float radiusB) {
    const float t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
    return glm::distance(p, a + t * (b - a)) - glm::mix(radiusA, radiusB, t);
}

// Ring around +Z.
float ring(const vec3& p, float radius, float thickness) {
    return glm::length(vec2(glm::length(vec2(p)) - radius, p.z)) - thickness;
}

// The lesser of two, blended over `width`. Quilez, "Smooth minimum", polynomial.
float blend(float a, float b, float width) {
    const float h = std::max(width - std::abs(a - b), 0.0f) / width;
    return std::min(a, b) - h * h * width * 0.25f;
}

float teapotDistance(const vec3& p) {
    float d = ellipsoid(p, {0, 0, 0}, {0.080f, 0.058f, 0.080f});
    d = blend(d, ellipsoid(p, {0, 0.052f, 0}, {0.046f, 0.014f, 0.046f}), 0.006f);
    d = blend(d, ellipsoid(p, {0, 0.076f, 0}, {0.014f, 0.012f, 0.014f}), 0.012f);
    d = blend(d, limb(p, {0.060f, -0.020f, 0}, {0.105f, 0.012f, 0}, 0.022f, 0.013f), 0.014f);
    d = blend(d, limb(p, {0.105f, 0.012f, 0}, {0.128f, 0.050f, 0}, 0.013f, 0.009f), 0.008f);
    return blend(d, ring(p - vec3(-0.088f, 0.006f, 0), 0.036f, 0.009f), 0.010f);
}

float bunnyDistance(const vec3& p) {
    float d = ellipsoid(p, {0, -0.02f, 0}, {0.058f, 0.055f, 0.075f});
    d = blend(d, ellipsoid(p, {0, 0.048f, 0.060f}, {0.034f, 0.034f, 0.040f}), 0.030f);
    const vec3 side(std::abs(p.x), p.y, p.z);
    d = blend(d, ellipsoid(side, {0.040f, -0.042f, -0.020f}, {0.028f, 0.038f, 0.046f}), 0.012f);
    d = blend(d, limb(side, {0.024f, -0.045f, 0.050f}, {0.026f, -0.066f, 0.082f}, 0.016f, 0.012f), 0.012f);
    d = blend(d, limb(side, {0.012f, 0.070f, 0.048f}, {0.026f, 0.138f, 0.020f}, 0.013f, 0.010f), 0.010f);
    return blend(d, ellipsoid(p, {0, -0.035f, -0.085f}, {0.022f, 0.022f, 0.022f}), 0.008f);
}

} // namespace

Mesh teapot() { return surfaceOf(teapotDistance, {-0.15f, -0.08f, -0.10f}, {0.16f, 0.11f, 0.10f}, 0.0040f); }

Mesh bunny() { return surfaceOf(bunnyDistance, {-0.09f, -0.10f, -0.13f}, {0.09f, 0.17f, 0.12f}, 0.0040f); }

Mesh torus() {
    return surfaceOf(
        [](const vec3& p) {
            return ring({p.x, p.z, p.y}, 0.070f, 0.032f);
        },
        {-0.12f, -0.05f, -0.12f}, {0.12f, 0.05f, 0.12f}, 0.0040f);
}

} // namespace shoal::bench
