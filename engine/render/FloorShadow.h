// The soft shadow that a body of ellipsoids casts on level ground, in closed form; no OpenGL.
//
// Seen from a place on the ground the light is a cap of even radiance. On the plane through an ellipsoid's
// centre at right angles to the way to the light, the cap is a disc and the ellipsoid casts an ellipse. The
// share of a disc that lies beyond a line at t of its radius is
//     C(t) = 1/2 + (t sqrt(1 - t^2) + asin t) / pi,
// so that a strip hides C(t1) - C(t0) of it, exactly. The ellipse is taken for a rectangle of the same area
// and axes, which is taken to hide the product of what the two strips hide that it lies in: integrated over
// the ground a body takes no more light than its silhouette does.
//
// Shafts are not dimmed. Single scattering in the film's water, under the light that open frames of it were
// filmed in, integrated along every ray around a shark, all that it sends itself left out, loses at most 9 %
// of the luminance at 1.5 m, 6 at 3 m, 5 at 6 m (6, 4 and 3 of 255), around a hand at 0.5 m 3 % (1.3), half
// of it over 6 to 30 degrees. As wide as that, on an even field, the eye sees something like a tenth (Yang
// and Makous 1997, "Implicit masking constrained by spatial inhomogeneities": 1.5 log units above its best
// threshold), and the film is not even: means over 8 degrees of it around the horizon change by 10 to 20 %
// (root mean square) in half a second.
#pragma once

#include "engine/occlusion/Ellipsoid.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace shoal::render {

struct FloorLight {
    glm::vec3 towards{0, 1, 0}; // unit, world frame
    float tangent = 0;          // of its radius
    glm::vec3 share{0};         // of the ground's irradiance that it gives, 0 to 1
    float height_m = 0;         // of the ground, world frame

    // 1 where its lower edge is well above the horizon, falling to 0 before shadows would grow without end.
    float raised() const;
};

// An ellipsoid's silhouette as the light sees it, as a rectangle of the same area.
struct FlatPiece {
    glm::vec3 middle{0};          // world frame
    glm::vec3 along{0}, aside{0}; // unit, at right angles to the way to the light and to each other
    float halfAlong_m = 0, halfAside_m = 0;
};

// Replaces out. body: world frame.
void flatten(std::span<const occlusion::Ellipsoid> body, const FloorLight& light,
             std::vector<FlatPiece>& out);

// The share of the light that a body hides from a place on the ground, 0 to 1. body: flattened for this
// light.
float covered(std::span<const FlatPiece> body, const FloorLight& light, const glm::vec2& groundXz);

// A part of the ground, along world x and z.
struct FloorPatch {
    glm::vec2 low{0}, high{0};
    int across = 0, down = 0; // cells, so small that what is hidden can be taken for linear in them; 0: none
    float strength = 0;       // to multiply what is hidden with, 0 to 1
};

// Outside of it the body hides nothing. No cells where it would take less than `minimum` of the ground's
// light anywhere; a body that takes a little more comes in faintly. body: flattened for this light.
FloorPatch patchOf(std::span<const FlatPiece> body, const FloorLight& light, float minimum);

} // namespace shoal::render
