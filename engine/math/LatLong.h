// The lat-long (equirectangular) map and the frame it lives in.
//
// env frame: right-handed, +Y up, the image's centre column looks along -Z, columns grow to the right:
//
//     u  0         0.25        0.5        0.75        1        v
//        +-----------+-----------+-----------+-----------+     0    +Y, straight up
//        |           |           |           |           |
//     +Z (behind)   -X         -Z (ahead)   +X        +Z |     0.5  the horizon
//        |           |           |           |           |
//        +-----------+-----------+-----------+-----------+     1    -Y, straight down
//
// Texel centres lie at half integers: texel (x, y) of a W x H map has u = (x + 0.5) / W, v = (y + 0.5) / H.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal {

// dir: unit length. Result: u in [0, 1], v in [0, 1]. At the poles u is arbitrary but finite.
template <class T> glm::vec<2, T> latLongFromDirection(const glm::vec<3, T>& dir) {
    const T invPi = std::numbers::inv_pi_v<T>;
    return {T(0.5) + std::atan2(dir.x, -dir.z) * T(0.5) * invPi,
            T(0.5) - std::asin(std::clamp(dir.y, T(-1), T(1))) * invPi};
}

// The inverse; uv may lie outside [0, 1] in u (it wraps). Result: unit length.
template <class T> glm::vec<3, T> directionFromLatLong(const glm::vec<2, T>& uv) {
    const T longitude = (uv.x - T(0.5)) * T(2) * std::numbers::pi_v<T>;
    const T latitude = (T(0.5) - uv.y) * std::numbers::pi_v<T>;
    const T ring = std::cos(latitude);
    return {ring * std::sin(longitude), std::sin(latitude), -ring * std::cos(longitude)};
}

// Solid angle in steradians of one texel of row y in a width x height map, exact: the band between two
// latitudes, 2 pi (sin a - sin b), shared by its texels. Rows sum to 4 pi.
inline double texelSolidAngle(int y, int width, int height) {
    const double pi = std::numbers::pi;
    const double top = std::sin(pi * (0.5 - static_cast<double>(y) / height));
    const double bottom = std::sin(pi * (0.5 - static_cast<double>(y + 1) / height));
    return 2.0 * pi * (top - bottom) / width;
}

} // namespace shoal
