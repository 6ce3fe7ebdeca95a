// Moves and shapes ellipsoids on joints until they hide what a skin hides, seen from points around it.
#pragma once

#include "content/make/models/occlusion/FitEllipsoids.h"
#include "engine/occlusion/SmoothLight.h"
#include "engine/scene/Surface.h"

#include <array>
#include <vector>

namespace shoal::make {

// Shares of directions that one pose of the skin hides from points around it.
struct Around {
    std::vector<glm::mat4> posedFromRest; // by joint; rigid
    std::vector<glm::vec3> places;
    std::vector<std::array<float, 2 * occlusion::kAxisCount>> hidden; // by place: shares at the axes' ends
};

// Distances from the skin at which places lie, metres. The skin's inside is never seen.
struct Shell {
    float nearest = 0.002f, farthest = 0.03f;
};

// Returns at most `count` unhidden places in front of the skin, spread by area; the same for the same seed.
Around lookAround(const scene::Surface& posed, std::vector<glm::mat4> posedFromRest, const Shell& shell,
                  int count, uint64_t seed);

// Returns the mean square difference at the places between what the ellipsoids and what the skin hides.
double missed(const std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses);

// Takes, one at a time, each step that makes missed() smaller: Hooke and Jeeves 1961, "Direct Search Solution
// of Numerical and Statistical Problems".
void fitToHidden(std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses);

} // namespace shoal::make
