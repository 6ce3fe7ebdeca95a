// Vertices of a primitive reordered, and flat normals where a file has none. Private to the glTF loader.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::scene {

// Unit length, computed in double so that no finite vector overflows; otherwise where there is no direction.
glm::vec3 safeNormalize(const glm::dvec3& v, const glm::vec3& otherwise);

// Some unit vector at right angles to a unit vector.
glm::vec3 perpendicular(const glm::vec3& unit);

// Vertex i becomes the old vertex source[i], with all its attributes and morphs. indices are the caller's
// affair.
void takeVertices(Primitive& primitive, std::span<const uint32_t> source);

// glTF 2.0 specification 3.7.2.1: three vertices a triangle, each with the triangle's normal; morph targets
// get the differences of the normals they make. Tangents and morphed tangents are dropped, as there.
void makeFlatNormals(Primitive& primitive);

} // namespace shoal::scene
