// An ellipsoid on every bone: it bends with the body for nothing. Ren et al. 2006, "Real-time Soft Shadows in
// Dynamic Scenes using Spherical Harmonic Exponentiation", have spheres; ellipsoids here are seen as spheres
// of the same outline's area.
#pragma once

#include "tests/baselines/occlusion/Visibility.h"

#include <span>
#include <vector>

namespace shoal::occlusion::baselines {

// Half axes are the columns of `axes`, orthogonal, metres.
struct Ellipsoid {
    glm::vec3 centre{0};
    glm::mat3 axes{1};
    int bone = 0;
};

// One for each bone that moves enough vertices, by their spread; at rest. parts: how many along the longest
// axis.
std::vector<Ellipsoid> fitEllipsoids(const BodyMesh& rest, std::span<const int> boneOf, int bones);

Ellipsoid moved(const Ellipsoid& at, const glm::mat4& worldFromRest); // rotation, translation, one scale

// A sphere that covers about as much of the view from here.
struct SeenSphere {
    glm::vec3 to{0};  // its centre from the point
    float radius = 0; // shorter than that
};
SeenSphere seenFrom(const glm::vec3& point, const Ellipsoid& at);

} // namespace shoal::occlusion::baselines
