// Light beneath ellipsoids: what they take is taken with the light that would have come from there, and what
// they send back of the light around them is added. Twin of shaders/occlusion/Bodies.glsl.
#pragma once

#include "engine/occlusion/Ellipsoid.h"
#include "engine/occlusion/SmoothLight.h"

#include <glm/vec4.hpp>

#include <span>

namespace shoal::occlusion {

struct Occluder {
    Ellipsoid<float> shape; // world
    float strength = 1;     // fades it in, 0 to 1
    glm::vec3 albedo{0};    // of its surface, in the space in which surfaces scale light
};

// What occluders take from a point of a surface.
struct Taken {
    float share = 0;       // of the cosine-weighted hemisphere, 0 to 1
    glm::vec3 radiance{0}; // out of diffuse radiance: what is lost, less what the occluders send
};

// What the surface's own body hides of it, less what its own occluders say of that: Folds, world; albedo: of
// that body.
struct Fold {
    glm::vec4 hidden{0};
    glm::vec3 albedo{0};
};

// One occluder after another takes what the former have left in its directions: of a density over directions
// that has the former's share and first moment and changes evenly across the view of the hemisphere from
// above, whose variance is a quarter. Over a hand's fingers and palm that comes nearer to the truth (5 % of
// the light) than shares that join as if they lay at random (7 %), than a sum (18 %) or the largest alone.
// own: of the surface's body, which the fold completes. light: in the world's frame.
Taken take(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> own, const Fold& fold,
           std::span<const Occluder> others, const SmoothLight& light);

// Share (w) and first moment (xyz: w times the mean direction) of what occluders take, joined likewise.
glm::vec4 hiddenBy(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders);

// What is left of a glossy lobe around this direction, 0 to 1.
float openLobe(const glm::vec3& p, const glm::vec3& direction, float roughness,
               std::span<const Occluder> occluders);

} // namespace shoal::occlusion
