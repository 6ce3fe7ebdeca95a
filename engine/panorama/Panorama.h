// Extrapolation of an ordinary photo to a full 360-degree panorama: Iorns 2016, section 5.3.
//
// Steps: find the main light; project the photo to latitude and longitude; widen it to 360 degrees and extend
// it up and down by seam insertion, which spares the light and vertical edges; blend the ends; extrapolate
// sky and ground to the poles; rotate the light to the middle column.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <glm/vec2.hpp>

#include <functional>
#include <optional>

namespace shoal::panorama {

// Called with the fraction that is done, 0 to 1, on the calling thread.
using Progress = std::function<void(double)>;

// The panorama is as wide as the photo's resolution allows, 512 to 4096.
struct PanoramaOptions {
    // Horizontal field of view of the photo, degrees, kMinFov_deg to kMaxFov_deg; empty: 65 along the
    // longer side, about that of a phone's main camera.
    std::optional<double> fov_deg;
    bool full = false; // whether seam insertion stretches it to both poles, as the thesis does
    Progress progress = [](double) {};
};

inline constexpr double kMinFov_deg = 10, kMaxFov_deg = 150;
inline constexpr int kMinSide = 16;     // least length of a photo's shorter side, pixels
inline constexpr double kMaxAspect = 8; // longer over shorter side

template <class Picture> struct Panorama {
    Picture latLong;         // 2:1
    glm::dvec2 lightInPhoto; // pixels; the centre of the first is at 0.5
    double lightLatitude_deg = 0;
};

// Extrapolates the photo; the panorama is display-coded or linear, as the photo is. Deterministic. Fails if
// the photo is too small or too elongated or the field of view is out of range; the error has no path.
template <class Picture> // ImageRgb8, or ImageRgbF of linear light
Result<Panorama<Picture>> panoramaFromPhoto(const Picture& photo, const PanoramaOptions& options);

// --- Completion of a partial panorama whose position on the sphere is known

// Edges as shares of the full lat-long picture, 0 to 1: left < right, top < bottom.
struct PanoramaPart {
    double left = 0, top = 0, right = 1, bottom = 1;
};

// Scales the part to its place and extrapolates sky and ground. Fills the gap between its right and its left
// edge by cross-fading the mirror images of the columns at both edges, none of which includes the main light.
// Fails if the part would be less than two pixels wide or high; the error has no path.
template <class Picture> Result<Picture> completePanorama(const Picture& photo, const PanoramaPart& part);

} // namespace shoal::panorama
