// What a body at rest hides of the world from its own surface: mouths, gills, what lies beneath fins and between fingers.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::occlusion {

// For each position: of the cosine-weighted hemisphere, how much is hidden (w, 0 to 1), and that share's first moment
// (xyz: w times the mean direction, same frame). indices: three a triangle; normals: unit, one a position. rays: of
// each position, in one pattern turned by its normal. Several threads.
std::vector<glm::vec4> findFolds(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                 std::span<const uint32_t> indices, int rays);

} // namespace shoal::occlusion
