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

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal {

// Returns u and v of a direction, each in [0, 1]; at the poles u is arbitrary but finite. dir: unit length.
template <class T> glm::vec<2, T> latLongFromDirection(const glm::vec<3, T>& dir) {
    const T invPi = std::numbers::inv_pi_v<T>;
    return {T(0.5) + std::atan2(dir.x, -dir.z) * T(0.5) * invPi,
            T(0.5) - std::asin(std::clamp(dir.y, T(-1), T(1))) * invPi};
}

// Computes latLongFromDirection() within 4e-6 of the map's height, without calls and branches; for maps of
// few texels; dir may have any length. Abramowitz and Stegun 1964, 4.4.49; the error is at most 1e-5 rad.
inline glm::vec2 latLongRoughly(const glm::vec3& dir) {
    const auto angle = [](float y, float x) { // angle of a point of a plane, -pi to pi
        const float ay = std::abs(y), ax = std::abs(x);
        const float t = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-30f), t2 = t * t;
        float a = ((((0.0208351f * t2 - 0.085133f) * t2 + 0.180141f) * t2 - 0.3302995f) * t2 + 0.999866f) * t;
        a = ay > ax ? std::numbers::pi_v<float> / 2 - a : a;
        a = x < 0 ? std::numbers::pi_v<float> - a : a;
        return std::copysign(a, y);
    };
    constexpr float kInvPi = std::numbers::inv_pi_v<float>;
    return {0.5f + angle(dir.x, -dir.z) * 0.5f * kInvPi,
            0.5f - angle(dir.y, std::sqrt(dir.x * dir.x + dir.z * dir.z)) * kInvPi};
}

// Returns the column within the map, for x at most one width beyond its edges.
inline int wrappedColumn(int x, int width) { return x < 0 ? x + width : x >= width ? x - width : x; }

// Returns the row within the map; beyond a pole lies the same row, half a turn away.
inline int rowOnSphere(int row, int height) {
    return row < 0 ? -1 - row : row >= height ? 2 * height - 1 - row : row;
}

// Returns the direction, of unit length: the inverse of latLongFromDirection(). u may lie outside [0, 1].
template <class T> glm::vec<3, T> directionFromLatLong(const glm::vec<2, T>& uv) {
    const T longitude = (uv.x - T(0.5)) * T(2) * std::numbers::pi_v<T>;
    const T latitude = (T(0.5) - uv.y) * std::numbers::pi_v<T>;
    const T ring = std::cos(latitude);
    return {ring * std::sin(longitude), std::sin(latitude), -ring * std::cos(longitude)};
}

// Returns the direction of the middle of texel (x, y) of a width x height map.
template <class T = float> glm::vec<3, T> texelDirection(int x, int y, int width, int height) {
    return directionFromLatLong(glm::vec<2, T>((T(x) + T(0.5)) / T(width), (T(y) + T(0.5)) / T(height)));
}

// Returns the sine of the latitude of a row's upper edge; row + 0.5 is its middle.
inline double sineOfRow(double row, int height) { return std::sin(std::numbers::pi * (0.5 - row / height)); }

// Returns the solid angle in steradians of one texel of row y in a width x height map, exactly: the band
// between two latitudes, 2 pi (sin a - sin b), shared by its texels. All texels sum to 4 pi.
inline double texelSolidAngle(int y, int width, int height) {
    return 2.0 * std::numbers::pi * (sineOfRow(y, height) - sineOfRow(y + 1, height)) / width;
}

// --- Cells of a grid over the map that a cap of the sphere touches

struct CellRange {
    glm::ivec2 first{0}, last{-1}; // rows are within the grid; columns may lie beyond an edge, and repeat
};

// Returns the cells that a cap touches. The cap's outermost meridians are sin(longitude) = sin(angle) /
// cos(latitude) from its middle; a cap that holds a pole touches all. dirEnv: unit; halfAngle: radians.
inline CellRange cellsOfCap(const glm::ivec2& cells, const glm::vec3& dirEnv, float halfAngle) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const glm::vec2 uv = latLongFromDirection(dirEnv);
    const float latitude = (0.5f - uv.y) * kPi;
    const bool polar = std::abs(latitude) + halfAngle >= kPi / 2;
    const float across = polar ? 0.5f : std::asin(std::sin(halfAngle) / std::cos(latitude)) / (2 * kPi);
    const auto cell = [](float share, int count) {
        return static_cast<int>(std::floor(share * static_cast<float>(count)));
    };
    const int left = cell(uv.x - across, cells.x);
    return {{left, std::max(cell(uv.y - halfAngle / kPi, cells.y), 0)},
            {std::min(cell(uv.x + across, cells.x), left + cells.x - 1),
             std::min(cell(uv.y + halfAngle / kPi, cells.y), cells.y - 1)}};
}

} // namespace shoal
