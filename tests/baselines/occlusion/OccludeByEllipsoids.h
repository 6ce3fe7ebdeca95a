// Diffuse and glossy light that ellipsoids block at a surface point, and the light that they reflect back, on
// the processor: twin of shaders/occlusion/Bodies.glsl, and the reference that it is tested against.
#pragma once

#include "content/make/models/occlusion/Silhouettes.h"

namespace shoal::occlusion {

// Diffuse light that ellipsoids block at a surface point.
struct OcclusionResult {
    float share = 0;       // of the cosine-weighted hemisphere, 0 to 1
    glm::vec3 radiance{0}; // out of diffuse radiance: what is lost, less what the occluders send
};

// Occlusion by the surface's own body beside its ellipsoids.
struct SelfOcclusion {
    glm::vec4 hidden{0}; // of a direction: w plus its product with xyz, which may be less than nothing
    glm::vec3 albedo{0}; // of that body
};

// own: of the surface's body, which the self-occlusion completes. Where several hide a direction in part,
// they do so as if they lay there at random.
OcclusionResult occlude(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> own,
                        const SelfOcclusion& selfOcclusion, std::span<const Occluder> others,
                        const SmoothLight& light);

// Returns the share of a glossy lobe around this direction that is left, 0 to 1.
float lobeVisibility(const glm::vec3& p, const glm::vec3& direction, float roughness,
                     std::span<const Occluder> occluders);

} // namespace shoal::occlusion
