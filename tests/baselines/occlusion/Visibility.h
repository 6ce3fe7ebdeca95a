// What methods that trace rays through a body answer.
#pragma once

#include "engine/occlusion/BodyMesh.h"

#include <concepts>
#include <cstddef>
#include <optional>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// Where a ray first meets a body: distance along the unit direction in metres, unit normal towards the ray's
// origin.
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

// Bytes that a method keeps for one body; what the chart shows as memory.
template <class Method>
concept KeepsMemory = requires(const Method& method) {
    { method.bytes() } -> std::convertible_to<std::size_t>;
};

} // namespace shoal::occlusion
