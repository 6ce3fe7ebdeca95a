// Projection between a rectilinear photo and latitude and longitude around the camera.
#pragma once

#include <cmath>
#include <numbers>

namespace shoal::panorama {

// A photo taken with a level pinhole camera: the horizon is its middle row.
//
// A column of the photo is a meridian. A point `up` focal lengths above the horizon has the latitude
// atan(up * cos(longitude)): at its sides the photo reaches less high than in its middle. To make a rectangle
// without cropping, the factor cos(longitude) is blended to 1 towards the top and bottom edges: the
// projection is exact at the horizon, and each edge becomes one parallel.
struct Lens {
    double width = 0, height = 0; // pixels
    double focal_px = 1;
    double longitude = 0, latitude = 0; // of the right edge; of the top edge's middle, radians

    // horizontalFov: radians, below pi.
    static Lens make(double width, double height, double horizontalFov) {
        Lens lens{width, height, width / 2 / std::tan(horizontalFov / 2)};
        lens.longitude = horizontalFov / 2;
        lens.latitude = std::atan(height / 2 / lens.focal_px);
        return lens;
    }

    // Longitudes grow to the right, latitudes upwards, in radians. The middle of the first pixel is at 0.5.
    double columnOf(double lon) const { return width / 2 + focal_px * std::tan(lon); }
    double rowOf(double lon, double lat) const {
        const double share = std::tan(lat) / std::tan(latitude); // -1 to 1
        const double narrow = std::cos(lon);
        return height / 2 * (1 - share / (narrow + (1 - narrow) * std::abs(share)));
    }
    double longitudeOf(double column) const { return std::atan((column - width / 2) / focal_px); }
    double latitudeOf(double lon, double row) const {
        const double up = 1 - row / (height / 2);
        const double narrow = std::cos(lon);
        // Solves rowOf() for share, which has the sign of up.
        const double share = up * narrow / (1 - (1 - narrow) * std::abs(up));
        return std::atan(share * std::tan(latitude));
    }
};

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

} // namespace shoal::panorama
