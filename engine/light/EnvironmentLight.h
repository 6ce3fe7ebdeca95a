// The light of an environment: made once per frame, immutable afterwards, free of OpenGL.
#pragma once

#include "engine/core/Image.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace shoal::light {

// Linear radiance, env frame, lat-long (engine/math/LatLong.h); level 0 first, each level half the one
// before, down to 2x1. Levels are means weighted by solid angle, so that every level has the same mean over
// the sphere.
struct RadiancePyramid {
    std::vector<ImageRgbF> levels;

    // Returns the level of this width in texels, which must exist.
    const ImageRgbF& ofWidth(int width) const {
        const auto level = std::ranges::find(levels, width, &ImageRgbF::width);
        assert(level != levels.end());
        return *level;
    }
};

// Radiance filtered by a GGX lobe of this perceptual roughness (glTF's; alpha = roughness^2) around each
// direction, with n = v = r: the split sum's first factor in Karis 2013, "Real Shading in Unreal Engine 4".
// Lookups are linear between texel centres, over the poles too (engine/light/Lookup.h).
struct GlossyLevel {
    float roughness = 0;
    ImageRgbF radianceLin; // empty where the radiance pyramid's level of the same index serves
};

// Method of making the diffuse map.
enum class DiffuseMethod {
    Default, // exact lobes on the sphere: ZonalFilter.h
    Thesis,  // every texel gathers every texel: BruteForceDiffuse.h
};

struct EnvironmentLight {
    RadiancePyramid radiance;
    // Radiance that a white matte surface reflects, by its normal: irradiance / pi, which is L in a uniform
    // environment of radiance L. Size: 64x32 for videos (thesis, section 4.1: 64x32 looks like 1024x512,
    // 32x16 does not), 512x256 for stills.
    ImageRgbF diffuse;
    std::vector<GlossyLevel> glossy; // by glossyPlans(): ascending roughness to 1, widths falling
};

} // namespace shoal::light
