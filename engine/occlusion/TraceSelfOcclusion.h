// Traces how much of its surroundings a body hides from its own surface in one pose: in mouths and gills,
// beneath fins, between fingers. For each vertex, by several threads; a fraction of a second a model.
#pragma once

#include "engine/occlusion/SmoothLight.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::occlusion {

// Self-occlusion of a surface point: the hidden share of a direction d is w + dot(xyz, d), which may be
// negative. shaders/occlusion/Bodies.glsl adds it to what ellipsoids hide.
inline float selfOcclusionAlong(const glm::vec4& selfOcclusion, const glm::vec3& direction) {
    return selfOcclusion.w + glm::dot(glm::vec3(selfOcclusion), direction);
}

// Views only; one frame. indices: three a triangle. Positions in none of them have no self-occlusion.
struct SelfOccludingMesh {
    std::span<const glm::vec3> positions, normals; // normals: unit, one a position
    std::span<const uint32_t> indices;             // of what lets no light through
};

// Rays are cast from each corner and from three points in each triangle, and the vertices get the values
// whose interpolation comes nearest to what the rays found. Corners alone would not do: at the roots of fins
// they lie inside the body, and would darken all around. Kavan et al. 2011, "Least Squares Vertex Baking".
// rays: from each of these points. Returns one value a position, in the mesh's frame.
std::vector<glm::vec4> traceSelfOcclusion(const SelfOccludingMesh& body, int rays);

// How much is hidden of that end of each axis that lies above a surface, 0 to 1.
using AxisOcclusion = std::array<float, kAxisCount>;

// That end of an axis which lies above the surface.
inline glm::vec3 axisAbove(const glm::vec3& normal, size_t axis) {
    return (glm::dot(normal, kAxes[axis]) < 0 ? -1.0f : 1.0f) * kAxes[axis];
}

// Self-occlusion added.
AxisOcclusion withSelfOcclusion(AxisOcclusion hidden, const glm::vec3& normal,
                                const glm::vec4& selfOcclusion);

// Of the cosine-weighted hemisphere how much is hidden (w, 0 to 1), and that share's first moment (xyz: w
// times the mean direction).
glm::vec4 occlusionMoments(const AxisOcclusion& hidden, const glm::vec3& normal);

// The self-occlusion with which what is hidden has nearly these moments. As far as ellipsoids hide as much,
// it is made independent of a direction's height above the surface: ellipsoids move against the skin, and the
// skin turns the self-occlusion.
glm::vec4 fitSelfOcclusion(const AxisOcclusion& hidden, const glm::vec3& normal, const glm::vec4& moments);

} // namespace shoal::occlusion
