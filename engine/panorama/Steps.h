// The steps of Panorama.h that stand alone: the lens, the light, seam insertion, the wrap-around, the poles.
// Pictures have 3 perceptually coded floats a pixel.
#pragma once

#include "engine/panorama/Panorama.h"

#include <opencv2/imgproc.hpp>

#include <cmath>
#include <numbers>
#include <vector>

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
        const double focal_px = width / 2 / std::tan(horizontalFov / 2);
        return {width, height, focal_px, horizontalFov / 2, std::atan(height / 2 / focal_px)};
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

// Returns a picture of this size that shows at (x, y) the column and row from(x, y) of `picture`, both
// counted from the middle of the first pixel. Beyond the edges the last pixel repeats.
template <class From>
cv::Mat remapped(const cv::Mat& picture, const cv::Size& size, int filter, From&& from) {
    cv::Mat2f places(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) places(y, x) = from(x, y);
    cv::Mat out;
    cv::remap(picture, out, places, cv::noArray(), filter, cv::BORDER_REPLICATE);
    return out;
}

// Position and size of a picture's brightest light source.
struct MainLight {
    cv::Point2d place; // pixels of the picture; the middle of the first one is (0.5, 0.5)
    double radius_px;  // of the disc of equal area
};

// Finds the light: blurs the radiance (after the thesis' inverse tone mapping) over about a hundredth of the
// picture's width, and takes the connected region around its maximum that is brighter than four fifths of it;
// the position is the region's centroid, weighted by radiance. Wide photos are reduced first.
MainLight findMainLight(const cv::Mat& photo);

// --- Widening of a picture by seam insertion (seam carving in reverse). A seam is a connected path from the
// top row to the bottom row, one pixel a row. Weights are one float a pixel.

// Returns the column of the minimum-cost seam in each row. The cost is the sum of the differences between
// pixels that removing the seam would make neighbours: those left and right of it and, where it steps
// sideways, one of those and the pixel above (forward energy: Rubinstein, Shamir, Avidan, "Improved Seam
// Carving for Video Retargeting", SIGGRAPH 2008, section 5). Differences are summed over the three
// components; beyond the left and right edge the last pixel repeats. weight, of the same size, is added for
// each pixel of the seam; it may be negative, and must be finite. Equal costs: leftmost at the bottom.
std::vector<int> minSeam(const cv::Mat& colours, const cv::Mat& weight);

// Returns the source column of each pixel of the picture widened to `columns`, in pixels of `colours` with
// centres at whole numbers. Never decreases along a row.
//
// Each pass doubles the seams that are the cheapest to remove (section 4.3 of Avidan and Shamir, "Seam
// Carving for Content-Aware Image Resizing", SIGGRAPH 2007). A pass inserts at most a tenth of the columns
// and raises the weight of doubled pixels, so that insertions spread. columns: at least colours.cols.
cv::Mat seamInsertionMap(
    const cv::Mat& colours, const cv::Mat& weight, int columns, const Progress& progress = [](double) {});

// Smooths a map's deviation from uniform stretching by a Gaussian. The ends and monotonicity are kept.
void smoothMap(std::vector<float>& map, double sigma_px);

// --- The ends and the poles

// Matches and blends the left and right end of a ring of 360 degrees. First geometry: the minimum-cost
// alignment of the two end columns, found as a seam through all row offsets of at most 8 degrees, warps each
// end half way to the other. Then colours: half of the remaining difference is subtracted at each end; the
// lower a band of the difference's spatial frequencies, the wider it fades out (multiband blending).
void blendWrapAround(cv::Mat& ring);

enum class PolarCap { Sky, Ground };

// Fills rows 0 to edge of a lat-long picture from the rows below, and fades into these over some degrees. For
// the nadir, flip the picture. edge: above 0 and below half the height.
//
// Colours: the solution of Laplace's equation on the cap with the edge row as boundary, in which the mth
// harmonic around the pole falls as (tan(c / 2) / tan(c0 / 2))^m with the colatitude c, so that nothing
// converges on the pole; times the picture's mean vertical gradient, damped within some 20 degrees.
// Texture, of the ground only (a sky is smooth): by-example synthesis on the tangent plane from a square just
// outside the cap, as the ratio to its blurred self, so that grain and contrast continue without repetition.
void fillPolarCap(cv::Mat& latLong, int edge, PolarCap kind);

} // namespace shoal::panorama
