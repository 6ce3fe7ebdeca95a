// A coarse distance field on every bone, marched: it bends with the body. Rays are cones, as in Wright 2015,
// "Dynamic Occlusion with Signed Distance Fields": the nearest pass of a ray by matter tells how much of the
// cone is free.
#pragma once

#include "tests/baselines/occlusion/Visibility.h"

#include <span>
#include <vector>

namespace shoal::occlusion::baselines {

// Signed distance to what one bone moves, on a grid in the rest frame.
struct DistanceGrid {
    int bone = 0;
    glm::vec3 low{0}, high{0}; // its box; half a cell's width inside its outermost samples
    glm::ivec3 count{0};
    std::vector<float> values; // metres

    float at(const glm::vec3& rest) const; // trilinear; outside the box, the distance to the box is added
    std::size_t bytes() const { return values.size() * sizeof(float); }
};
static_assert(KeepsMemory<DistanceGrid>);

// cells: along the longest side of each box.
std::vector<DistanceGrid> distanceGrids(const BodyMesh& rest, std::span<const int> boneOf, int bones,
                                        int cells);

struct PlacedGrid {
    const DistanceGrid* grid = nullptr;
    glm::mat4 restFromWorld{1};
    glm::vec3 centre{0}; // of its box, in the world
    float radius = 0;
};

// 0 to 1: how free a cone of this half angle's tangent is between two distances.
float coneFree(std::span<const PlacedGrid> grids, const glm::vec3& origin, const glm::vec3& direction,
               float tangent, float nearest, float furthest);

} // namespace shoal::occlusion::baselines
