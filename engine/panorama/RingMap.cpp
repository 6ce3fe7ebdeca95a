#include "engine/panorama/RingMap.h"

#include "engine/panorama/SeamWeights.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace shoal::panorama {

namespace {

constexpr double px(double degrees) { return degrees * kMapPixelsPerDegree; }

// The light and a margin are not stretched; beside them stretching sets in over a fade.
constexpr double kLargestLight = px(10), kAroundLight = px(5), kFade = px(14);
constexpr double kMaxSideways = 6, kMaxUpward = 4; // times
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

// Widens columns first to last (exclusive) to `count` and appends them to the map.
void insertColumns(const Colours& picture, const Plane& weight, int first, int last, int count,
                   const Progress& progress, std::vector<float>& map) {
    if (first >= last) return;
    for (const float at : columnInsertionMap(columnsOf(picture, first, last), columnsOf(weight, first, last),
                                             std::max(count, last - first), progress))
        map.push_back(at + static_cast<float>(first));
}

std::vector<float> insertSideways(const Colours& patch, const LightInPatch& light, const Progress& progress) {
    const int w = patch.width, middle = std::clamp(static_cast<int>(std::lround(light.column)), 0, w);
    const Plane weight =
        seamWeights(patch, {light.column, std::min(light.radius, kLargestLight) + kAroundLight,
                            std::min(kFade, w * 0.12)});
    const auto maximum = [](int columns) {
        return std::min<int>(kMapWidth / 2, static_cast<int>(kMaxSideways) * columns);
    };
    const int left = middle == 0 ? 0 : std::max(maximum(middle), kMapWidth - maximum(w - middle));
    std::vector<float> map;
    insertColumns(patch, weight, 0, middle,
                  middle == w ? kMapWidth : std::min(left, kMapWidth - (w - middle)),
                  within(progress, 0, 0.5), map);
    insertColumns(patch, weight, middle, w, kMapWidth - static_cast<int>(map.size()),
                  within(progress, 0.5, 1), map);
    smoothMap(map, kSmoothAround);
    return map;
}

// The patch widened to the ring, at a quarter of the map's columns (enough to find seams across it),
// transposed.
cv::Mat widenedAndTransposed(const Colours& patch, const std::vector<float>& column) {
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

RingMap makeRingMap(const Colours& patch, const Lens& lens, const LightInPatch& light, double bandLatitude,
                    const Progress& progress) {
    RingMap ring;
    ring.column = insertSideways(patch, light, within(progress, 0, 0.8));

    // Between the light and the horizon, and around both, heights stay as they are.
    const double horizon = patch.height / 2.0;
    const double margin = std::min(light.radius, kLargestLight) + kAroundLight / 2;
    const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, patch.height * 1.0)); };
    const int upperEnd = row(std::min(light.row - margin, horizon - kAroundLight / 2));
    const int lowerStart = row(std::max(light.row + margin, horizon + kAroundLight / 2));
    const double lacking = px((bandLatitude - lens.latitude) / kRadiansPerDegree);
    const auto rowsFor = [&](int have) {
        return static_cast<int>(std::clamp(have + lacking, have * 1.0, have * kMaxUpward));
    };
    const Colours turned = coloursOf(widenedAndTransposed(patch, ring.column));
    const Plane weight = seamWeights(turned, {-1e9, 0, 0});
    const int up = rowsFor(upperEnd), down = rowsFor(patch.height - lowerStart);
    insertColumns(turned, weight, 0, upperEnd, up, within(progress, 0.8, 0.9), ring.row);
    for (int y = upperEnd; y < lowerStart; ++y) ring.row.push_back(static_cast<float>(y));
    insertColumns(turned, weight, lowerStart, patch.height, down, within(progress, 0.9, 1), ring.row);
    smoothMap(ring.row, kSmoothUp);
    ring.top = lens.latitude + (up - upperEnd) * kRadiansPerDegree / kMapPixelsPerDegree;
    return ring;
}

} // namespace shoal::panorama
