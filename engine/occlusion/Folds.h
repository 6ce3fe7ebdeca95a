// What a body in one pose hides of the world from its own surface: mouths, gills, what lies beneath fins and
// between fingers.
#pragma once

#include "engine/occlusion/Shade.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::occlusion {

// Views only; one frame. indices: three a triangle. Positions in none of them have no folds.
struct FoldingBody {
    std::span<const glm::vec3> positions, normals; // normals: unit, one a position
    std::span<const uint32_t> indices;             // of what lets no light through
};

// What corners say in between comes as near as it can to what is seen from them and from three points in each
// triangle, for corners alone are often buried, where fins have their roots, and would darken what lies
// around: Kavan et al. 2011, "Least Squares Vertex Baking". rays: from each of these points. Several threads.
// own: the body's own ellipsoids, which this completes. Returns Fold::hidden, one a position, same frame.
std::vector<glm::vec4> findFolds(const FoldingBody& body, std::span<const Occluder> own, int rays);

} // namespace shoal::occlusion
