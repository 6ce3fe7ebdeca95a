// How much of the directions above a surface point ellipsoids hide: for a few axes, the same for all points
// (engine/occlusion/SmoothLight.h). From these, what a body's baked self-occlusion has to add is worked out.
// The light itself is taken in shaders/occlusion/Bodies.glsl. All in the light's frame.
#pragma once

#include "content/make/models/occlusion/TraceSelfOcclusion.h"
#include "engine/occlusion/Ellipsoid.h"

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

// Where several ellipsoids hide a direction in part, they do so as if they lay there at random.
void addOcclusion(const EllipsoidSilhouette& silhouette, float strength, const glm::vec3& normal,
                  AxisOcclusion& hidden);
AxisOcclusion axisOcclusion(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders);

// Traced self-occlusion becomes what completes the body's own ellipsoids. mesh: that it was traced on.
void completeOwn(const SelfOccludingMesh& mesh, std::span<const Occluder> own,
                 std::span<glm::vec4> selfOcclusion);

} // namespace shoal::occlusion
