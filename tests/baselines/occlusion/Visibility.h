// Answers of methods that trace rays through a body.
#pragma once

#include "engine/occlusion/BodyMesh.h"

#include <concepts>
#include <optional>

#include <glm/glm.hpp>

namespace shoal::occlusion {

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

} // namespace shoal::occlusion
