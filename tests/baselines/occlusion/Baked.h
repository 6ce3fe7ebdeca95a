// Methods that bake what each vertex sees.
#pragma once

#include "engine/math/SphericalHarmonics.h"
#include "tests/baselines/occlusion/Directions.h"
#include "tests/baselines/occlusion/Visibility.h"

namespace shoal::occlusion::baselines {

// One number a vertex, baked: the share of the cosine-weighted hemisphere that is free. Zhukov, Iones and
// Kronin 1998, "An Ambient Light Illumination Model"; Landis 2002, "Production-Ready Global Illumination".
//
// Per vertex, 0 to 1. start: how far from the surface rays begin, metres.
std::vector<float> bakeAmbientOcclusion(const BodyMesh& mesh, const Occluded& occluded, int rays,
                                        float start);

// Precomputed radiance transfer of a matte surface in spherical harmonics. Sloan, Kautz and Snyder 2002,
// "Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, Low-Frequency Lighting Environments",
// section 4.1, shadowed.
//
// Frame: the one that it was baked in.
struct Transfer {
    int bands = 4;            // 1 to math::kShBands
    std::vector<float> terms; // [vertex][l m]: 1/pi times the integral of visibility, cosine and Y_lm

    int count() const { return bands * bands; }
    std::size_t bytes() const { return terms.size() * sizeof(float); }
    // Radiance leaving white matte vertex i in an environment with these coefficients; may ring below 0.
    glm::vec3 radiance(size_t vertex, const math::ShRgb& environment) const;
};

Transfer bakeTransfer(const BodyMesh& mesh, const Occluded& occluded, int bands, int rays, float start);

} // namespace shoal::occlusion::baselines
