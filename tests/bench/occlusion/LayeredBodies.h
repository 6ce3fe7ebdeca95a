// Each body of a scene in layered fragment buffers of its own, as it is posed.
#pragma once

#include "engine/occlusion/BodyMesh.h"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

// Pixels from a ray's origin to its first test, so that it does not hit its own surface. The values give each
// kind of buffers the fewest gaps.
template <class Buffers> inline constexpr float startOf = 0.32f;
template <> inline constexpr float startOf<occlusion::OllfbThesis> = 3;

template <class Buffers> class LayeredBodies {
  public:
    LayeredBodies(const Scene& scene, const typename Buffers::Options& options)
        : nearest_(2 * startOf<Buffers> / static_cast<float>(options.resolution)) {
        for (const Body& body : scene.bodies) {
            const occlusion::BodyMesh mesh = body.posed.view();
            bodies_.push_back({Buffers::make(mesh, options).value(), occlusion::boundingSphere(mesh)});
        }
    }

    // own: the body that the ray starts on; other bodies that touch it may be nearer than `nearest_`.
    bool occluded(const glm::vec3& origin, const glm::vec3& direction, size_t own) const {
        for (size_t b = 0; b < bodies_.size(); ++b)
            if (meets(bodies_[b].sphere, origin, direction) &&
                bodies_[b].buffers.trace(origin, direction, b == own ? nearestOf(bodies_[b]) : 0))
                return true;
        return false;
    }
    std::optional<occlusion::Hit> trace(glm::vec3 origin, glm::vec3 direction, float nearest) const {
        std::optional<occlusion::Hit> first;
        for (const One& body : bodies_) {
            if (!meets(body.sphere, origin, direction)) continue;
            const auto hit = body.buffers.trace(origin, direction, std::max(nearest, nearestOf(body)));
            if (hit && (!first || hit->distance < first->distance)) first = hit;
        }
        return first;
    }
    size_t bytes() const {
        size_t sum = 0;
        for (const One& body : bodies_) sum += body.buffers.bytes();
        return sum;
    }

  private:
    struct One {
        Buffers buffers;
        Sphere sphere;
    };
    float nearestOf(const One& body) const { return nearest_ * body.sphere.radius; }
    static bool meets(const Sphere& sphere, const glm::vec3& origin, const glm::vec3& direction) {
        const glm::vec3 to = sphere.centre - origin;
        const float along = glm::dot(to, direction), square = sphere.radius * sphere.radius;
        const float outside = glm::dot(to, to) - square;
        return outside <= 0 || (along > 0 && outside <= along * along);
    }
    float nearest_ = 0; // of a sphere's radius
    std::vector<One> bodies_;
};

} // namespace shoal::bench
