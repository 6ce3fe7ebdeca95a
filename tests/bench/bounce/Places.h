// Places where animals are in a dive with nobody there.
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

// Every so many seconds of the film of this dive, from half of that on, a few fish of all kinds.
Result<std::vector<Places>> placesOf(const std::string& dive, double every_s);

} // namespace shoal::bench
