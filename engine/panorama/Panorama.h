// An ordinary photo grown to a full surround: Iorns 2016, section 5.3.
//
// Find the main light; take the photo as a piece of the lat-long picture; grow it by seams sideways to 360
// degrees and up and down to the band that people look at, leaving the light and what is upright beside it
// alone; close the ring; continue sky and ground to the poles; turn the light to the middle column.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/panorama/Grow.h"

#include <glm/vec2.hpp>

#include <optional>

namespace shoal::panorama {

struct GrowOptions {
    // Horizontal field of view of the photo, degrees, kLeastFov_deg to kLargestFov_deg; empty: 65 along the
    // longer side, as a phone's main camera.
    std::optional<double> fov_deg;
    int width = 0; // of the panorama, even; 0: what the photo's detail fills, 512 to 4096
    Progress progress;
};

inline constexpr double kLeastFov_deg = 10, kLargestFov_deg = 150;
inline constexpr int kLeastSide = 16;       // pixels of a photo's shorter side
inline constexpr double kLargestAspect = 8; // longer over shorter side

template <class Picture> struct Grown {
    Picture latLong;         // 2:1
    glm::dvec2 lightInPhoto; // pixels, the middle of the first is 0.5
    double lightLatitude_deg = 0;
    double joint = 0, ownGradient = 0; // see JointStrength, of coded values
};

// Coded pictures stay coded, linear radiance linear. Deterministic. Error without a path where the photo is
// too small, too long, or the field of view out of range.
Result<Grown<ImageRgb8>> grow(const ImageRgb8& photo, const GrowOptions& options);
Result<Grown<ImageRgbF>> grow(const ImageRgbF& radianceLin, const GrowOptions& options);

} // namespace shoal::panorama
