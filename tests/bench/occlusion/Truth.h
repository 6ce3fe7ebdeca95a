// Light that reaches a surface past all occluders, by traced rays.
#pragma once

#include "tests/bench/occlusion/Cells.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

struct OccludedLight {
    std::vector<std::vector<glm::dvec3>>
        diffuse;               // [environment][receiver]: radiance leaving a white matte surface
    std::vector<double> noise; // [environment]: standard error of it, relative root mean square
    std::vector<float> open;   // [receiver]: share of the cosine-weighted hemisphere that is free
};

// Casts two rays a cell at random places in it; their difference gives the noise of their mean. Bodies that
// send light back reflect rays off matte surfaces until they are free or hit a fifth. Runs on all cores.
OccludedLight occludedLight(const Scene& scene, const Rays& rays, std::span<const Receiver> receivers,
                            const Cells& cells);

} // namespace shoal::bench
