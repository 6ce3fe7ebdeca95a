// Vertices of a primitive reordered, and normals and tangents where a file has none.
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

// Vertices after splitting: vertex i is the old vertex source[i], with tangents[i].
struct TangentSplit {
    std::vector<uint32_t> source;
    std::vector<glm::vec4>
        tangents; // xyz: where u grows; w: +1 where cross(normal, xyz) points to the image's top
    std::vector<uint32_t> indices; // replaces the primitive's
};

// Tangents as MikkTSpace makes them, in whose convention normal maps are baked; Debian packages no library of
// it. Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 3 and appendix A: the tangents of
// triangles that share a corner (same position, normal and texture coordinate) and have their texture the
// same way round are averaged, weighted by the corner's angle. Simpler than its reference implementation in
// that such triangles need not hang together by edges. texCoord: the normal map's set, 0 or 1, which must be
// there, as must normals. Texture coordinates as in glTF, v growing downwards. Corners without a direction
// (no area, no extent in the texture) get any tangent at right angles to their normal.
TangentSplit makeTangents(const Primitive& primitive, int texCoord);

} // namespace shoal::scene
