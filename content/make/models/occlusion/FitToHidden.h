// Fits ellipsoids, each carried by a joint, so that they occlude what the skin occludes for points around it.
#pragma once

#include "content/make/models/occlusion/FitEllipsoids.h"
#include "engine/occlusion/SmoothLight.h"
#include "engine/scene/Surface.h"

#include <array>
#include <vector>

namespace shoal::make {

// Occlusion by the skin in one pose, sampled at points around it.
struct Around {
    std::vector<glm::mat4> posedFromRest; // one rigid transform for each joint
    std::vector<glm::vec3> places;
    std::vector<std::array<float, 2 * occlusion::kAxisCount>> hidden; // [place][axis end], occluded shares
};

// Range of the places' distances from the skin, metres, outside it only: nobody ever sees its inside.
struct Shell {
    float nearest = 0.002f, farthest = 0.03f;
};

// Samples occlusion at up to `count` exposed places near the skin, uniform by area; deterministic by seed.
Around lookAround(const scene::Surface& posed, std::vector<glm::mat4> posedFromRest, const Shell& shell,
                  int count, uint64_t seed);

// Returns the mean squared error of the ellipsoids' occlusion against the skin's, over all places.
double missed(const std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses);

// Minimises missed() by direct search, one parameter step at a time: Hooke and Jeeves 1961, "Direct Search
// Solution of Numerical and Statistical Problems".
void fitToHidden(std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses);

} // namespace shoal::make
