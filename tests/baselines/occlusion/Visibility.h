// Answers of methods that trace rays through a body, and rays between mirrors that show themselves.
#pragma once

#include "engine/occlusion/BodyMesh.h"
#include "engine/occlusion/Directions.h"

#include <concepts>
#include <optional>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// Inverse of packDirection(), twin of unpackDirection() in shaders/occlusion/Octahedral.glsl.
inline glm::vec3 unpackDirection(uint32_t packed, int bits) {
    const glm::vec2 square =
        bits == 8 ? glm::unpackSnorm2x8(static_cast<uint16_t>(packed)) : glm::unpackSnorm2x16(packed);
    const glm::vec3 turned = math::directionFromOctahedral(square);
    return {turned.x, turned.z, turned.y};
}

// First point where a ray meets a body: distance along the unit direction in metres, unit normal towards the
// ray's origin.
struct Hit {
    float distance = 0;
    glm::vec3 normal{0, 0, 0};
};

// A method that answers single rays in the body's frame, from beyond `nearest` metres on; `direction` is
// unit length.
template <class Method>
concept TracesRays = requires(const Method& method, glm::vec3 origin, glm::vec3 direction, float nearest) {
    { method.trace(origin, direction, nearest) } -> std::same_as<std::optional<Hit>>;
};

// A ray after its bounces, and their number.
struct Reflected {
    glm::vec3 origin{0}, direction{0, 0, 1}; // the last ray, which meets nothing unless `caught`
    int bounces = 0;
    bool caught = false; // it still meets a surface after the last bounce allowed
};

// Follows a ray from mirror to mirror, at most `maximum` bounces. Body frame, metres; direction unit; each
// ray begins beyond `nearest`.
template <TracesRays Method>
Reflected followMirrors(const Method& method, glm::vec3 origin, glm::vec3 direction, float nearest,
                        int maximum) {
    Reflected ray{origin, direction, 0, false};
    for (;;) {
        const auto hit = method.trace(ray.origin, ray.direction, nearest);
        if (!hit) return ray;
        if (ray.bounces == maximum) {
            ray.caught = true;
            return ray;
        }
        ray.origin += hit->distance * ray.direction;
        ray.direction = glm::normalize(glm::reflect(ray.direction, hit->normal));
        ++ray.bounces;
    }
}

} // namespace shoal::occlusion
