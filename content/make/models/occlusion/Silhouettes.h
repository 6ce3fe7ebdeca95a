// Computes which directions above a surface point ellipsoids hide, for a few axes, the same for all points
// (engine/occlusion/SmoothLight.h), and from that what a body's baked self-occlusion has to add. The light is
// subtracted in shaders/occlusion/Bodies.glsl. All in the light's frame.
#pragma once

#include "content/make/models/occlusion/TraceSelfOcclusion.h"
#include "engine/occlusion/Ellipsoid.h"

#include <span>

namespace shoal::occlusion {

struct Occluder {
    Ellipsoid shape;
    float strength = 1;  // fades it in, 0 to 1
    glm::vec3 albedo{0}; // albedo of its surface, in the space in which surfaces scale light
};

// The directions that an ellipsoid hides from a point. m: the point, relative to its centre; Q: the
// symmetric matrix with x.Qx = 1 on the surface. A ray along d hits it if -Qm.d > sqrt(m.Qm - 1) |d|_Q. The
// difference of the two sides grows across the silhouette by one over the distance of the tangent plane there
// from the centre. This slope is taken to be the same all around, which is exact at the skin and for spheres;
// far away it is that of a disc as large as the shadow.
class EllipsoidSilhouette {
  public:
    EllipsoidSilhouette(const Ellipsoid& shape, const glm::vec3& p);

    // Returns the hidden share of a round patch around a direction. sine: of its half angle; share: the
    // patch's, of the sphere.
    float hides(const glm::vec3& direction, float sine, float share) const;
    float cap() const { return cap_; } // share of the sphere that the ellipsoid covers

  private:
    glm::mat3 matrix_{1};
    glm::vec3 slope_{0};
    float edge_ = 0, width_ = 0, cap_ = 0;
};

// Adds what an ellipsoid hides. Several that hide a direction in part are treated as if placed at random.
void addOcclusion(const EllipsoidSilhouette& silhouette, float strength, const glm::vec3& normal,
                  AxisOcclusion& hidden);
AxisOcclusion axisOcclusion(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders);

// Replaces traced self-occlusion by the part that completes the body's own ellipsoids. mesh: the traced one.
void completeOwn(const SelfOccludingMesh& mesh, std::span<const Occluder> own,
                 std::span<glm::vec4> selfOcclusion);

} // namespace shoal::occlusion
