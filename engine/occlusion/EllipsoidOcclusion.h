// How much of the directions above a surface point ellipsoids hide: for a few axes, the same for all points
// (SmoothLight.h). From these, what a body's baked self-occlusion has to add is worked out. The light itself
// is taken in shaders/occlusion/Bodies.glsl. All in the light's frame.
#pragma once

#include "engine/occlusion/FitEllipsoids.h"
#include "engine/occlusion/SmoothLight.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <span>

namespace shoal::occlusion {

struct Occluder {
    Ellipsoid shape;
    float strength = 1;  // fades it in, 0 to 1
    glm::vec3 albedo{0}; // of its surface, in the space in which surfaces scale light
};

// An ellipsoid as a point sees it, which directions it hides. m: the point from its centre; Q: the symmetric
// matrix that makes it a sphere, squared. A ray along d meets it where -Qm.d > sqrt(m.Qm - 1) |d|_Q. That
// difference grows across the silhouette by one over the distance of the tangent plane there from the centre,
// which is taken to be the same all around: right at the skin and for spheres, and far away that of a disc as
// large as its shadow.
class EllipsoidSilhouette {
  public:
    EllipsoidSilhouette(const Ellipsoid& shape, const glm::vec3& p);

    // Share of a round patch around a direction that is hidden. sine: of its half angle; share: of the
    // sphere.
    float hides(const glm::vec3& direction, float sine, float share) const;
    float cap() const { return cap_; } // share of the sphere that the ellipsoid covers

  private:
    glm::mat3 matrix_{1};
    glm::vec3 slope_{0};
    float edge_ = 0, width_ = 0, cap_ = 0;
};

// How much is hidden of that end of each axis that lies above a surface, 0 to 1. Where several ellipsoids
// hide a direction in part, they do so as if they lay there at random.
using AxisOcclusion = std::array<float, kAxisCount>;
void addOcclusion(const EllipsoidSilhouette& silhouette, float strength, const glm::vec3& normal,
                  AxisOcclusion& hidden);
AxisOcclusion axisOcclusion(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders);

// Baked self-occlusion: the hidden share of a direction d is w + dot(xyz, d), which may be negative.
inline float selfOcclusionAlong(const glm::vec4& selfOcclusion, const glm::vec3& direction) {
    return selfOcclusion.w + glm::dot(glm::vec3(selfOcclusion), direction);
}
// Self-occlusion added.
AxisOcclusion withSelfOcclusion(AxisOcclusion hidden, const glm::vec3& normal,
                                const glm::vec4& selfOcclusion);

// Of the cosine-weighted hemisphere how much is hidden (w, 0 to 1), and that share's first moment (xyz: w
// times the mean direction).
glm::vec4 occlusionMoments(const AxisOcclusion& hidden, const glm::vec3& normal);

// The self-occlusion with which what is hidden has nearly these moments. As far as ellipsoids hide as much,
// it is made independent of a direction's height above the surface: ellipsoids move against the skin, and the
// skin turns the self-occlusion.
glm::vec4 fitSelfOcclusion(const AxisOcclusion& hidden, const glm::vec3& normal, const glm::vec4& moments);

} // namespace shoal::occlusion
