// Exact ray casting against triangles by Embree, the reference for every method.
#pragma once

#include "content/make/video/Embree.h"
#include "tests/bench/occlusion/Mesh.h"

#include <memory>
#include <optional>
#include <type_traits>

namespace shoal::bench {

// A point on one of the meshes.
struct Touch {
    float distance = 0;
    uint32_t mesh = 0, triangle = 0;
    glm::vec3 weights{0}; // of the triangle's corners
};

// Many threads may use it at once. Copies share their data.
class Rays {
  public:
    // meshes: kept by the caller; each at its place in the world.
    explicit Rays(const std::vector<const Mesh*>& meshes);

    bool occluded(const glm::vec3& origin, const glm::vec3& direction, float nearest) const;
    std::optional<Touch> touch(const glm::vec3& origin, const glm::vec3& direction, float nearest) const;
    // Returns a hit as methods do, with the interpolated normal turned towards the origin.
    std::optional<occlusion::Hit> trace(glm::vec3 origin, glm::vec3 direction, float nearest) const;

  private:
    std::vector<const Mesh*> meshes_;
    std::shared_ptr<std::remove_pointer_t<RTCScene>> scene_;
};

} // namespace shoal::bench
