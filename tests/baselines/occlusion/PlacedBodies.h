// Many bodies, each asked in its own frame.
#pragma once

#include "engine/occlusion/BodyMesh.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <cmath>
#include <vector>

namespace shoal::occlusion {

// Where a body stands. The method is another's and must outlive this.
template <TracesRays Method> struct Placed {
    const Method* method;
    glm::mat4 bodyFromWorld{1}; // rotation, translation, and one scale for all axes
    Sphere sphereWorld;         // holds the body
};

// bodySphere: body frame.
template <TracesRays Method>
Placed<Method> place(const Method& method, const Sphere& bodySphere, const glm::mat4& worldFromBody) {
    const float scale = glm::length(glm::vec3(worldFromBody[0]));
    return {&method,
            glm::inverse(worldFromBody),
            {glm::vec3(worldFromBody * glm::vec4(bodySphere.centre, 1)), bodySphere.radius * scale}};
}

// Whether a ray (unit direction) meets a sphere between `nearest` and `farthest` metres.
inline bool meets(const Sphere& sphere, const glm::vec3& origin, const glm::vec3& direction, float nearest,
                  float farthest) {
    const glm::vec3 to = sphere.centre - origin;
    const float along = glm::dot(to, direction);
    const glm::vec3 aside = to - along * direction; // of the centre: exact far away too
    const float half2 = sphere.radius * sphere.radius - glm::dot(aside, aside);
    if (half2 < 0) return false;
    const float half = std::sqrt(half2);
    return along + half >= nearest && along - half <= farthest;
}

// Itself a method, in the world's frame.
template <TracesRays Method> class Bodies {
  public:
    std::vector<Placed<Method>> placed;

    std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction, float nearest) const {
        std::optional<Hit> first;
        for (const Placed<Method>& body : placed) {
            if (!meets(body.sphereWorld, origin, direction, nearest, first ? first->distance : INFINITY))
                continue;
            const glm::mat3 turn(body.bodyFromWorld);
            const glm::vec3 turned = turn * direction;
            const float scale = glm::length(turned); // of lengths in the body's frame
            const auto hit = body.method->trace(glm::vec3(body.bodyFromWorld * glm::vec4(origin, 1)),
                                                turned / scale, nearest * scale);
            if (!hit || (first && hit->distance >= first->distance * scale)) continue;
            first = Hit{hit->distance / scale, glm::transpose(turn) * hit->normal / scale};
        }
        return first;
    }
};

} // namespace shoal::occlusion
