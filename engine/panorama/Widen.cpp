#include "engine/panorama/Widen.h"

#include "engine/panorama/Protect.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace shoal::panorama {

namespace {

constexpr double px(double degrees) { return degrees * kMapPixelsPerDegree; }

// What the light takes of the patch that must not be stretched, and how softly growth begins beside it.
constexpr double kLargestLight = px(10), kAroundLight = px(5), kFade = px(14);
constexpr double kMostSideways = 6, kMostUpward = 4; // times
constexpr double kSmoothAround = px(2), kSmoothUp = px(2);

cv::Mat matOf(const Colours& picture) {
    return {picture.height, picture.width, CV_32FC3, const_cast<float*>(picture.pixels.data())};
}

Colours coloursOf(const cv::Mat& mat) {
    Colours out(mat.cols, mat.rows);
    mat.copyTo(cv::Mat(mat.rows, mat.cols, CV_32FC3, out.pixels.data()));
    return out;
}

Progress within(const Progress& progress, double from, double to) {
    return [&progress, from, to](double share) {
        if (progress) progress(from + (to - from) * share);
    };
}

template <int kChannels>
Image<float, kChannels> columnsOf(const Image<float, kChannels>& in, int first, int last) {
    Image<float, kChannels> out(last - first, in.height);
    for (int y = 0; y < in.height; ++y)
        std::copy(in.at(first, y), in.at(first, y) + static_cast<ptrdiff_t>(out.width) * kChannels,
                  out.at(0, y));
    return out;
}

// Columns first to last (exclusive), grown to count and put to the end of the map.
void growPart(const Colours& picture, const Plane& weight, int first, int last, int count,
              const Progress& progress, std::vector<float>& map) {
    if (first >= last) return;
    for (const float at : growEvenly(columnsOf(picture, first, last), columnsOf(weight, first, last),
                                     std::max(count, last - first), progress))
        map.push_back(at + static_cast<float>(first));
}

std::vector<float> growSideways(const Colours& patch, const LightInPatch& light, const Progress& progress) {
    const int w = patch.width, middle = std::clamp(static_cast<int>(std::lround(light.column)), 0, w);
    const Plane weight = protect(patch, {light.column, std::min(light.radius, kLargestLight) + kAroundLight,
                                         std::min(kFade, w * 0.12)});
    const auto most = [](int columns) {
        return std::min<int>(kMapWidth / 2, static_cast<int>(kMostSideways) * columns);
    };
    const int left = middle == 0 ? 0 : std::max(most(middle), kMapWidth - most(w - middle));
    std::vector<float> map;
    growPart(patch, weight, 0, middle, middle == w ? kMapWidth : std::min(left, kMapWidth - (w - middle)),
             within(progress, 0, 0.5), map);
    growPart(patch, weight, middle, w, kMapWidth - static_cast<int>(map.size()), within(progress, 0.5, 1),
             map);
    smoothMap(map, kSmoothAround);
    return map;
}

// The patch as wide as the ring, a quarter of the map's pixels: enough to find seams across it. Turned on its
// side.
cv::Mat grownAndTurned(const Colours& patch, const std::vector<float>& column) {
    cv::Mat columns(patch.height, kMapWidth / 4, CV_32F), rows(columns.size(), CV_32F), out, turned;
    for (int y = 0; y < columns.rows; ++y)
        for (int x = 0; x < columns.cols; ++x) {
            columns.at<float>(y, x) = column[static_cast<size_t>(4 * x + 2)];
            rows.at<float>(y, x) = static_cast<float>(y);
        }
    cv::remap(matOf(patch), out, columns, rows, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::transpose(out, turned);
    return turned;
}

} // namespace

RingMap widen(const Colours& patch, const Lens& lens, const LightInPatch& light, double bandLatitude,
              const Progress& progress) {
    RingMap ring;
    ring.column = growSideways(patch, light, within(progress, 0, 0.8));

    // Between the light and the horizon, and around both, heights stay as they are.
    const double horizon = patch.height / 2.0;
    const double margin = std::min(light.radius, kLargestLight) + kAroundLight / 2;
    const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, patch.height * 1.0)); };
    const int upperEnd = row(std::min(light.row - margin, horizon - kAroundLight / 2));
    const int lowerStart = row(std::max(light.row + margin, horizon + kAroundLight / 2));
    const double lacking = px((bandLatitude - lens.latitude) / kRadiansPerDegree);
    const auto rowsFor = [&](int have) {
        return static_cast<int>(std::clamp(have + lacking, have * 1.0, have * kMostUpward));
    };
    const Colours turned = coloursOf(grownAndTurned(patch, ring.column));
    const Plane weight = protect(turned, {-1e9, 0, 0});
    const int up = rowsFor(upperEnd), down = rowsFor(patch.height - lowerStart);
    growPart(turned, weight, 0, upperEnd, up, within(progress, 0.8, 0.9), ring.row);
    for (int y = upperEnd; y < lowerStart; ++y) ring.row.push_back(static_cast<float>(y));
    growPart(turned, weight, lowerStart, patch.height, down, within(progress, 0.9, 1), ring.row);
    smoothMap(ring.row, kSmoothUp);
    ring.top = lens.latitude + (up - upperEnd) * kRadiansPerDegree / kMapPixelsPerDegree;
    return ring;
}

} // namespace shoal::panorama
