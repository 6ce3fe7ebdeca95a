// What lights the objects: made once per frame of the surround, immutable afterwards, free of OpenGL.
#pragma once

#include "engine/core/Image.h"

#include <vector>

namespace shoal::light {

// Linear radiance, env frame, lat-long (engine/math/LatLong.h); level 0 first, each level half the one
// before, down to 2x1. Levels are means weighted by solid angle, so that every level has the same mean over
// the sphere.
struct RadiancePyramid {
    std::vector<ImageRgbF> levels;
};

// Radiance after filtering by a GGX lobe of this perceptual roughness (glTF's; alpha = roughness^2) around
// the direction, with n = v = r (Karis 2013, "Real Shading in Unreal Engine 4", the split sum's first
// factor).
struct GlossyLevel {
    float roughness = 0; // the mirror's, level 0, is the little that its texels amount to
    ImageRgbF
        radianceLin; // empty where it is the radiance pyramid's level of the same index, as the mirror is
};

struct EnvironmentLight {
    RadiancePyramid radiance;
    // Radiance leaving a white matte surface by its normal: irradiance / pi. 64x32. A uniform surround of
    // radiance L gives L.
    ImageRgbF diffuse;
    // Ascending roughness from 0 to 1; widths halve from level to level: the mip chain of one texture.
    std::vector<GlossyLevel> glossy;
};

} // namespace shoal::light
