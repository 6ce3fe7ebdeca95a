// Diffuse light under occlusion by ray tracing, the reference for the closed forms.
#pragma once

#include "Scenes.h"
#include "content/make/models/occlusion/Bvh.h"

#include <vector>

namespace shoal {

struct SurfacePoint {
    size_t body = 0;
    glm::vec3 position{0}, normal{0, 1, 0};
    glm::vec4 selfOcclusion{0};
};

// Returns points spread evenly over the surface of one body.
std::vector<SurfacePoint> scatter(const OcclusionScene& scene, size_t body, int count);

class Truth {
  public:
    Truth(const OcclusionScene& scene, const ImageRgbF& light);

    glm::dvec3 unoccluded(const glm::vec3& normal) const; // irradiance / pi, sum over all texels

    // Returns the light that occlusion takes. self: whether the point's own body occludes it too. bounces:
    // diffuse, off bodies of their mean albedo; 0: black bodies. rays: number from the point.
    glm::dvec3 lost(const SurfacePoint& at, bool self, int bounces, int rays) const;

    // Returns whether the point lies within another body, where it is never seen.
    bool buried(const SurfacePoint& at) const;

  private:
    struct Met {
        size_t body = 0;
        glm::vec3 place{0}, normal{0}; // normal: towards the ray's origin
        bool fromInside = false;
    };
    // Returns the first surface on a ray, but for those of one body.
    std::optional<Met> meet(const glm::vec3& from, const glm::vec3& direction, size_t leftOut) const;
    glm::dvec3 reflected(const Met& at, int bounces, uint64_t& state) const;
    glm::dvec3 radiance(const glm::vec3& direction) const;

    const OcclusionScene& scene_;
    const ImageRgbF& light_;
    std::vector<occlusion::Bvh> trees_; // by body
};

} // namespace shoal
