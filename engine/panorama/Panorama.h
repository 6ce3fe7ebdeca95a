// Extrapolation of an ordinary photo to a full 360-degree panorama: Iorns 2016, section 5.3.
//
// Find the main light (FindLight.h); project the photo to latitude and longitude (Lens.h); widen it by seam
// insertion to 360 degrees and heighten it to a band around the horizon, protecting the light and vertical
// edges (RingMap.h); blend the ends (WrapBlend.h); extrapolate sky and ground to the poles (PolarCaps.h);
// rotate the light to the middle column.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/panorama/SeamInsertion.h"

#include <glm/vec2.hpp>

#include <optional>

namespace shoal::panorama {

struct PanoramaOptions {
    // Horizontal field of view of the photo, degrees, kMinFov_deg to kMaxFov_deg; empty: 65 along the
    // longer side, as of a phone's main camera.
    std::optional<double> fov_deg;
    int width = 0; // of the panorama, even; 0: by the photo's resolution, 512 to 4096
    Progress progress;
};

inline constexpr double kMinFov_deg = 10, kMaxFov_deg = 150;
inline constexpr int kMinSide = 16;     // pixels of a photo's shorter side
inline constexpr double kMaxAspect = 8; // longer over shorter side

template <class Picture> struct Panorama {
    Picture latLong;         // 2:1
    glm::dvec2 lightInPhoto; // pixels, the middle of the first is 0.5
    double lightLatitude_deg = 0;
    double wrapStep = 0, usualStep = 0; // see WrapDiscontinuity, of coded values
};

// Coded pictures stay coded, linear radiance linear. Deterministic. Error without a path where the photo is
// too small, too long, or the field of view out of range.
Result<Panorama<ImageRgb8>> panoramaFromPhoto(const ImageRgb8& photo, const PanoramaOptions& options);
Result<Panorama<ImageRgbF>> panoramaFromPhoto(const ImageRgbF& radianceLin, const PanoramaOptions& options);

} // namespace shoal::panorama
