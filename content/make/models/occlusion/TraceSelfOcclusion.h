// Tracing of a body's self-occlusion: how much of its surroundings it hides from its own surface in one pose,
// in mouths and gills, beneath fins, between fingers. For each vertex, by several threads.
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

// A body's surface, in one frame; views only. indices: three a triangle. Positions that no triangle uses get
// no self-occlusion.
struct SelfOccludingMesh {
    std::span<const glm::vec3> positions, normals; // normals: unit, one a position
    std::span<const uint32_t> indices;             // triangles that let no light through
};

// Returns cosine-weighted directions over the half sphere around +Z, stratified: Shirley and Chiu 1997 by
// rings of Vogel's spiral.
std::vector<glm::vec3> cosineDirections(int count);

// Casts rays from each corner and from three points in each triangle, and gives the vertices the values whose
// interpolation comes nearest to the result. Rays from corners alone are not enough: at the roots of fins the
// corners lie inside the body, and would darken their surroundings. Kavan et al. 2011, "Least Squares Vertex
// Baking". rays: number from each point. Returns one value for each position, in the mesh's frame.
std::vector<glm::vec4> traceSelfOcclusion(const SelfOccludingMesh& body, int rays);

// Hidden share of each axis' end that lies above a surface, 0 to 1.
using AxisOcclusion = std::array<float, kAxisCount>;

// Returns the end of an axis that lies above the surface.
inline glm::vec3 axisAbove(const glm::vec3& normal, size_t axis) {
    return (glm::dot(normal, kAxes[axis]) < 0 ? -1.0f : 1.0f) * kAxes[axis];
}

// Adds self-occlusion.
AxisOcclusion withSelfOcclusion(AxisOcclusion hidden, const glm::vec3& normal,
                                const glm::vec4& selfOcclusion);

// Returns the hidden share of the cosine-weighted hemisphere (w, 0 to 1), and its first moment (xyz: w times
// the mean direction).
glm::vec4 occlusionMoments(const AxisOcclusion& hidden, const glm::vec3& normal);

// Returns the self-occlusion that gives nearly these moments together with `hidden`. As far as ellipsoids
// hide as much, it does not depend on a direction's height above the surface: ellipsoids move against the
// skin, and the skin turns the self-occlusion.
glm::vec4 fitSelfOcclusion(const AxisOcclusion& hidden, const glm::vec3& normal, const glm::vec4& moments);

} // namespace shoal::occlusion
