// Reorders a primitive's vertices, makes normals and tangents where a file has none, and levels of detail.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::scene {

// Returns the vector at unit length, or `otherwise` if it has no direction. It computes in doubles, so that
// no finite vector overflows.
glm::vec3 safeNormalize(const glm::dvec3& v, const glm::vec3& otherwise);

// Returns a unit vector at right angles to a unit vector.
glm::vec3 perpendicular(const glm::vec3& unit);

// Makes vertex i the old vertex source[i], with its attributes and morph targets. The indices stay unchanged.
void takeVertices(Primitive& primitive, std::span<const uint32_t> source);

// Makes flat normals by the glTF 2.0 specification, 3.7.2.1: three vertices a triangle, each with its normal;
// morph targets get the change of that normal. Tangents, those of morph targets too, are dropped as it asks.
void makeFlatNormals(Primitive& primitive);

// Vertices after splitting: vertex i is the old vertex source[i], with tangents[i].
struct TangentSplit {
    std::vector<uint32_t> source;
    std::vector<glm::vec4>
        tangents; // xyz: where u grows; w: +1 where cross(normal, xyz) points to the image's top
    std::vector<uint32_t> indices; // replaces the primitive's
};

// Makes tangents in MikkTSpace's convention, in which normal maps are baked; Debian packages no library of
// it. Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 3 and appendix A: averages the
// tangents of triangles that share a corner (same position, normal and texture coordinate) and have their
// texture the same way round, weighted by the corner's angle; such triangles need not share edges here.
// texCoord: the normal map's set, 0 or 1; the primitive must have it, and normals. v grows downwards. Corners
// without a direction (no area, no extent in the texture) get any tangent at right angles to their normal.
TangentSplit makeTangents(const Primitive& primitive, int texCoord);

// A level of detail: a triangle smaller than a few pixels costs as much as a large one.
struct Lod {
    std::vector<uint32_t> vertices; // indices of the primitive's vertices that it uses
    std::vector<uint32_t> indices;  // triangles, into `vertices`
    float error = 0;                // approximate greatest displacement of the surface, primitive's units
};

// Makes levels of about half the triangles of the one before, finest first, by quadric edge collapse
// (meshoptimizer). Makes none of meshes that cannot be reduced and of primitives with morph targets.
// posed: the vertices' positions in the pose in which the error is measured.
std::vector<Lod> makeLods(const Primitive& primitive, std::span<const glm::vec3> posed);

} // namespace shoal::scene
