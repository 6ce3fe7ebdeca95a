// Positions of animals in a dive without a player.
#pragma once

#include "engine/core/Result.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace shoal::bench {

struct Places {
    int frame = 0;                   // of the film
    std::vector<glm::ivec3> fish_mm; // env frame, from the camera
};

// Returns places of a few fish of all kinds every so many seconds of the dive's film, first at half of that.
Result<std::vector<Places>> placesOf(const std::string& dive, double every_s);

} // namespace shoal::bench
