// Light beneath ellipsoids: from a point of a surface they hide the ends of a few axes, the same for all
// points (SmoothLight.h), each more or less; its light is taken, and what they send back of the light around
// them is added. Twin of shaders/occlusion/Bodies.glsl. All in the light's frame.
#pragma once

#include "engine/occlusion/Ellipsoid.h"
#include "engine/occlusion/SmoothLight.h"

#include <glm/vec4.hpp>

#include <span>

namespace shoal::occlusion {

struct Occluder {
    Ellipsoid shape;
    float strength = 1;  // fades it in, 0 to 1
    glm::vec3 albedo{0}; // of its surface, in the space in which surfaces scale light
};

// What occluders take from a point of a surface.
struct Taken {
    float share = 0;       // of the cosine-weighted hemisphere, 0 to 1
    glm::vec3 radiance{0}; // out of diffuse radiance: what is lost, less what the occluders send
};

// What the surface's own body hides of it beside its own occluders.
struct Fold {
    glm::vec4 hidden{0}; // of a direction: w plus its product with xyz, which may be less than nothing
    glm::vec3 albedo{0}; // of that body
};

// own: of the surface's body, which the fold completes. Where several hide a direction in part, they do so as
// if they lay there at random.
Taken take(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> own, const Fold& fold,
           std::span<const Occluder> others, const SmoothLight& light);

// What is left of a glossy lobe around this direction, 0 to 1.
float openLobe(const glm::vec3& p, const glm::vec3& direction, float roughness,
               std::span<const Occluder> occluders);

// How much is hidden of that end of each axis that lies above a surface, 0 to 1.
using Hidden = std::array<float, kAxisCount>;
Hidden hiddenBy(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders);

// A fold besides.
Hidden folded(Hidden hidden, const glm::vec3& normal, const glm::vec4& fold);

// Of the cosine-weighted hemisphere how much is hidden (w, 0 to 1), and that share's first moment (xyz: w
// times the mean direction).
glm::vec4 momentsOf(const Hidden& hidden, const glm::vec3& normal);

// The Fold::hidden with which what is hidden has nearly these moments, which something must hide. As far as
// ellipsoids hide as much, it says nothing of how high above the surface a direction is: they move against
// the skin, which turns the fold.
glm::vec4 completing(const Hidden& hidden, const glm::vec3& normal, const glm::vec4& moments);

} // namespace shoal::occlusion
