// Bounding volume hierarchy over triangles, for rays. It is hand-written because it is installed with the
// game, which does without Embree; the rays of a whole model take only a second or two. tests/bench/occlusion
// uses Embree.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace shoal::occlusion {

class Bvh {
  public:
    // indices: three a triangle. No ray hits a triangle without area.
    Bvh(std::span<const glm::vec3> positions, std::span<const uint32_t> indices);

    struct Touch {
        float distance = 0;
        uint32_t triangle = 0; // index of the triangle in `indices`
        float u = 0, v = 0;    // weights of its second and third corner
    };
    // Returns the nearest triangle hit between the two distances, from either side; any: the first one found.
    // Many threads may call it at once.
    std::optional<Touch> first(const glm::vec3& origin, const glm::vec3& direction, float nearest,
                               float furthest, bool any = false) const;
    bool blocked(const glm::vec3& origin, const glm::vec3& direction, float nearest, float furthest) const {
        return first(origin, direction, nearest, furthest, true).has_value();
    }

  private:
    struct Node {
        glm::vec3 low, high;
        uint32_t first = 0; // index of a triangle, or of the first of two nodes
        uint32_t count = 0; // number of triangles; 0: the node has two nodes
    };
    struct Triangle {
        glm::vec3 corner, edge1, edge2;
        uint32_t index;
    };

    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;
};

} // namespace shoal::occlusion
