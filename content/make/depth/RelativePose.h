// Relative pose of a camera between two frames, found on the sphere from the directions of the same points.
// Right-handed; directions have unit length and lie in each frame's own env axes. Any thread.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace shoal::depth {

struct Correspondence {
    glm::dvec3 first, second; // directions of one point, in the first and in the second frame
};

struct RelativePose {
    glm::dmat3 secondFromFirst{1}; // rotation of directions
    glm::dvec3 towards{0, 0, -1};  // direction to the second camera, unit length, in the first frame's axes
    double parallax_rad = 0;       // median angle by which points moved beyond the rotation
    double agreement = 0;          // 1: all points lie in front of the camera; 0: half lie behind it
};

// Below this parallax there is only noise of the flow, and nothing can be triangulated.
constexpr double kMinParallax_rad = 0.003;
constexpr double kMinAgreement = 0.7;

// Returns true if the camera has really moved, so that distances follow from the parallax.
inline bool isTranslation(const RelativePose& pose) {
    return pose.parallax_rad >= kMinParallax_rad && pose.agreement >= kMinAgreement;
}

// Minimises the angles between second directions and their epipolar planes (Hartley and Zisserman 2004, 9.6;
// on the sphere: Fujiki et al. 2007) with Cauchy weights, so that animals that move count little.
RelativePose relativePose(const std::vector<Correspondence>& points);

struct Triangulated {
    double inverse = 0;      // inverse distance from the first camera, in units of one over the baseline
    double parallax_rad = 0; // negative: behind the camera, a wrong match
    double offPlane_rad = 0; // angle of the second direction from the epipolar plane
    double sinToMovement =
        0; // sine of the angle between direction and movement; at 0 nothing can be measured
};

Triangulated triangulate(const RelativePose& pose, const Correspondence& point);

// Returns the pose for the exchanged frames: the first camera seen from the second.
RelativePose inverted(const RelativePose& pose);

} // namespace shoal::depth
