// An EnvironmentLight in the graphics card's formats: half floats, all filtered maps in one picture. Made on
// the decode thread, so that the render thread only uploads it.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace shoal::light {

using HalfImage = Image<uint16_t, 4>; // half floats, alpha 1

// Selection of unfiltered maps, for surfaces too smooth for the filtered maps and the thesis' glossy lookup.
enum class MirrorMaps {
    None,    // no surface needs them
    Mirrors, // the pyramid's levels that glossyPlans() names
    Pyramid, // all of it
};

// Treatment of radiance above kMaxHalf, which half floats cannot hold: a sun in an HDR picture.
enum class TooBright {
    Cut,
    Scale, // all maps hold radiance / PackedLight::scale; steps exceed 1 % below 10^-10 of the maximum
};

struct PackedLight {
    float scale = 1; // factor from the maps' values to radiance
    // All filtered maps, each with a border of one texel that continues the sphere, so that linear lookups
    // need no special case at the seam and the poles.
    HalfImage atlas;
    // Place of each filtered map in the atlas, roughest first (the first is the diffuse map too): u, v of the
    // map times xy plus zw.
    std::vector<glm::vec4> places;
    std::vector<HalfImage> mirrors;     // mip levels
    std::vector<float> mirrorRoughness; // of the unfiltered levels, then of the smoothest filtered one
};

// Reuses the buffers of out while sizes stay.
void packLight(const EnvironmentLight& light, MirrorMaps mirrors, PackedLight& out,
               TooBright tooBright = TooBright::Cut);

} // namespace shoal::light
