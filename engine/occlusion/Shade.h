// Light beneath ellipsoids: what they take is taken with the light that would have come from there, and what
// they send back of the light around them is added. Twin of shaders/occlusion/Bodies.glsl.
#pragma once

#include "engine/occlusion/Ellipsoid.h"
#include "engine/occlusion/SmoothLight.h"

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

// Shares of several ellipsoids join as if they lay at random, 1 - product of (1 - share): over a hand's
// fingers and palm that comes out at the right mean, where a sum takes a tenth too much and the largest alone
// too little. light: in the world's frame.
Taken take(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders,
           const SmoothLight& light);

// What is left of a glossy lobe around this direction, 0 to 1.
float openLobe(const glm::vec3& p, const glm::vec3& direction, float roughness,
               std::span<const Occluder> occluders);

} // namespace shoal::occlusion
