// An EnvironmentLight as the graphics side wants it: half floats, all filtered maps in one picture. Made on
// the decode thread, so that the frame's thread has nothing to do but hand it over.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace shoal::light {

using HalfImage = Image<uint16_t, 4>; // half floats, alpha 1

// What surfaces smoother than the filtered maps, or the thesis' glossy lookup, sample.
enum class MirrorMaps {
    None,    // no surface needs them
    Mirrors, // the pyramid's levels that glossyPlans() names
    Pyramid, // all of it
};

// What becomes of radiance above kMaxHalf, which half floats cannot hold: a sun in an HDR picture.
enum class TooBright {
    Cut,
    Scale, // all maps hold radiance / PackedLight::scale; below 10^-10 of the brightest, steps exceed 1 %
};

struct PackedLight {
    float scale = 1; // radiance is this times what the maps hold
    // Each map with a border of one texel around it that holds what lies there on the sphere, so that linear
    // lookups need to know of neither seam nor pole.
    HalfImage atlas;
    // Where map k of the filtered ones lies, roughest first (the first is the diffuse map too): its u, v
    // times xy plus zw is a place in the atlas.
    std::vector<glm::vec4> places;
    std::vector<HalfImage> mirrors;     // mip levels
    std::vector<float> mirrorRoughness; // of the unfiltered levels, then of the smoothest filtered one
};

// Buffers of out are reused while sizes stay.
void packLight(const EnvironmentLight& light, MirrorMaps mirrors, PackedLight& out,
               TooBright tooBright = TooBright::Cut);

} // namespace shoal::light
