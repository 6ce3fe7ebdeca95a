#include "tests/baselines/occlusion/Fragments.h"

#include "tests/baselines/occlusion/Directions.h"

namespace shoal::occlusion::baselines {

// right x up = along, so that a front, wound counter-clockwise for who looks at it, runs clockwise in x and
// y.
OrthoView viewAlong(const glm::vec3& direction, const glm::vec3& centre, float radius, int size) {
    const glm::mat3 frame = frameAround(direction);
    return {frame[0], frame[1], frame[2], centre, radius, size};
}

Sphere boundingSphereOf(std::span<const Triangles> bodies) {
    glm::vec3 low(1e30f), high(-1e30f);
    for (const Triangles& body : bodies)
        for (const glm::vec3& p : body.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    Sphere sphere{0.5f * (low + high), 0};
    for (const Triangles& body : bodies)
        for (const glm::vec3& p : body.positions)
            sphere.radius = std::max(sphere.radius, glm::distance(p, sphere.centre));
    sphere.radius *= 1.001f;
    return sphere;
}

} // namespace shoal::occlusion::baselines
