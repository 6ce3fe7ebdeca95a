// One number a vertex, baked: the share of the cosine-weighted hemisphere that is free. Zhukov, Iones and
// Kronin 1998, "An Ambient Light Illumination Model"; Landis 2002, "Production-Ready Global Illumination".
#pragma once

#include "tests/baselines/occlusion/Directions.h"
#include "tests/baselines/occlusion/Visibility.h"

namespace shoal::occlusion::baselines {

// Per vertex, 0 to 1. start: how far from the surface rays begin, metres.
std::vector<float> bakeAmbientOcclusion(const BodyMesh& mesh, const Occluded& occluded, int rays,
                                        float start);

} // namespace shoal::occlusion::baselines
