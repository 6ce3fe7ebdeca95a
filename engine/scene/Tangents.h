// Tangents by the convention of MikkTSpace, in which normal maps are baked; Debian packages no library of it.
// Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 3 and appendix A; grouping and weights
// as in the reference implementation's description: tangents of triangles that share a corner (same position,
// normal and texture coordinate), hang together by edges and have their texture the same way round are
// averaged, weighted by the corner's angle.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <vector>

namespace shoal::scene {

// Vertices after splitting: vertex i is the old vertex source[i], with tangents[i].
struct TangentSplit {
    std::vector<uint32_t> source;
    std::vector<glm::vec4>
        tangents; // xyz: where u grows; w: +1 where cross(normal, xyz) points to the image's top
    std::vector<uint32_t> indices; // replaces the primitive's
};

// texCoord: the normal map's set, 0 or 1, which must be there, as must normals. Texture coordinates as in
// glTF, v growing downwards. Corners without a direction (no area, no extent in the texture) get any tangent
// at right angles to their normal.
TangentSplit makeTangents(const Primitive& primitive, int texCoord);

} // namespace shoal::scene
