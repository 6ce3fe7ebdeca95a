// Ellipsoids on joints, moved and shaped until they hide what a skin hides, seen from around it.
#pragma once

#include "content/make/models/occlusion/FitEllipsoids.h"
#include "engine/occlusion/SmoothLight.h"
#include "engine/scene/Surface.h"

#include <array>
#include <vector>

namespace shoal::make {

// One pose of the skin.
struct Around {
    std::vector<glm::mat4> posedFromRest; // by joint; rigid
    std::vector<glm::vec3> places;
    std::vector<std::array<float, 2 * occlusion::kAxisCount>> hidden; // by place: of the axes' ends, 0 to 1
};

// How far from the skin places lie, metres. Nobody looks at the skin's inside.
struct Shell {
    float nearest = 0.002f, farthest = 0.03f;
};

// At most `count` places in the open before the skin, by its area. The same for the same seed.
Around lookAround(const scene::Surface& posed, std::vector<glm::mat4> posedFromRest, const Shell& shell,
                  int count, uint64_t seed);

// Of what is hidden at the places, by the ellipsoids against by the skin: mean square.
double missed(const std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses);

// One at a time takes each step that makes missed() less: Hooke and Jeeves 1961, "Direct Search Solution of
// Numerical and Statistical Problems".
void fitToHidden(std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses);

} // namespace shoal::make
