#include "engine/panorama/RingMap.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace shoal::panorama {

namespace {

constexpr double px(double degrees) { return degrees * kMapPixelsPerDegree; }

// The light and a margin around it are not stretched; outside the margin stretching increases over kFade.
constexpr double kLargestLight = px(10), kAroundLight = px(5), kFade = px(14);
constexpr double kMaxSideways = 6, kMaxUpward = 4; // greatest stretching
constexpr double kSmoothAround = px(2), kSmoothUp = px(2);
// Weights that keep seams away.
constexpr double kProhibitive = 10; // more than any pixel can differ from its neighbour
constexpr double kVertical = 4;     // times the edge's own step
constexpr double kTexture = 0.25;   // times the local gradient

// Columns that no seam may cross, middle - half to middle + half; beyond them the weight falls over `fade`
// columns.
struct ProtectedColumns {
    double middle = 0, half = 0, fade = 0; // pixels
};

// Returns weights for seamInsertionMap(): prohibitive within the protected columns, high along vertical edges
// as long as a quarter of the picture's height, and slightly raised by any texture.
cv::Mat seamWeights(const cv::Mat& picture, const ProtectedColumns& columns) {
    cv::Mat grey, across, down, vertical;
    cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
    const cv::Matx13f between(-0.5f, 0, 0.5f);
    cv::filter2D(grey, across, CV_32F, between, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::filter2D(grey, down, CV_32F, between.t(), {-1, -1}, 0, cv::BORDER_REPLICATE);

    // Steps of one sign add up along a vertical edge; those of texture cancel.
    cv::boxFilter(across, vertical, CV_32F, {1, std::max(1, picture.rows / 4)}, {-1, -1}, true,
                  cv::BORDER_REPLICATE);
    vertical = cv::abs(vertical);
    // The space between two close edges, such as a post, is protected with them.
    const int close = std::max(3, picture.cols / 32) | 1;
    cv::morphologyEx(vertical, vertical, cv::MORPH_CLOSE, cv::Mat::ones(1, close, CV_8U));
    cv::dilate(vertical, vertical, cv::Mat::ones(1, 3, CV_8U));

    cv::Mat texture = cv::abs(across) + cv::abs(down);
    cv::GaussianBlur(texture, texture, {}, std::max(0.5, picture.cols / 120.0), 0, cv::BORDER_REPLICATE);

    cv::Mat weight = kVertical * vertical + kTexture * texture;
    const double usual = cv::mean(weight)[0] + 1e-3;
    for (int x = 0; x < picture.cols; ++x) {
        const double beyond = std::abs(x + 0.5 - columns.middle) - columns.half;
        const double near = columns.fade > 0 ? std::clamp(1 - beyond / columns.fade, 0.0, 1.0) : 0.0;
        weight.col(x) += beyond <= 0 ? kProhibitive : 4 * usual * near * near;
    }
    return weight;
}

Progress within(const Progress& progress, double from, double to) {
    return [&progress, from, to](double share) {
        if (progress) progress(from + (to - from) * share);
    };
}

// Widens columns first to last (exclusive) to `count` and appends them to the map: the means of their source
// columns over all rows, so that vertical lines stay straight.
void insertColumns(const cv::Mat& picture, const cv::Mat& weight, int first, int last, int count,
                   const Progress& progress, std::vector<float>& map) {
    if (first >= last) return;
    cv::Mat mean;
    cv::reduce(seamInsertionMap(picture.colRange(first, last), weight.colRange(first, last),
                                std::max(count, last - first), progress),
               mean, 0, cv::REDUCE_AVG);
    for (const float at : cv::Mat_<float>(mean)) map.push_back(at + static_cast<float>(first));
}

std::vector<float> insertSideways(const cv::Mat& patch, const LightInPatch& light, const Progress& progress) {
    const int w = patch.cols, middle = std::clamp(static_cast<int>(std::lround(light.column)), 0, w);
    const cv::Mat weight =
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

// Returns the patch widened to the ring, at a quarter of the map's columns (enough to find seams across it),
// transposed.
cv::Mat widenedAndTransposed(const cv::Mat& patch, const std::vector<float>& column) {
    cv::Mat columns(patch.rows, kMapWidth / 4, CV_32F), rows(columns.size(), CV_32F), out, turned;
    for (int y = 0; y < columns.rows; ++y)
        for (int x = 0; x < columns.cols; ++x) {
            columns.at<float>(y, x) = column[static_cast<size_t>(4 * x + 2)];
            rows.at<float>(y, x) = static_cast<float>(y);
        }
    cv::remap(patch, out, columns, rows, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::transpose(out, turned);
    return turned;
}

} // namespace

RingMap makeRingMap(const cv::Mat& patch, const Lens& lens, const LightInPatch& light, double bandLatitude,
                    const Progress& progress) {
    RingMap ring;
    ring.column = insertSideways(patch, light, within(progress, 0, 0.8));

    // Between the light and the horizon, and around both, heights are not stretched.
    const double horizon = patch.rows / 2.0;
    const double margin = std::min(light.radius, kLargestLight) + kAroundLight / 2;
    const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, patch.rows * 1.0)); };
    const int upperEnd = row(std::min(light.row - margin, horizon - kAroundLight / 2));
    const int lowerStart = row(std::max(light.row + margin, horizon + kAroundLight / 2));
    const double lacking = px((bandLatitude - lens.latitude) / kRadiansPerDegree);
    const auto rowsFor = [&](int have) {
        return static_cast<int>(std::clamp(have + lacking, have * 1.0, have * kMaxUpward));
    };
    const cv::Mat turned = widenedAndTransposed(patch, ring.column);
    const cv::Mat weight = seamWeights(turned, {-1e9, 0, 0});
    const int up = rowsFor(upperEnd), down = rowsFor(patch.rows - lowerStart);
    insertColumns(turned, weight, 0, upperEnd, up, within(progress, 0.8, 0.9), ring.row);
    for (int y = upperEnd; y < lowerStart; ++y) ring.row.push_back(static_cast<float>(y));
    insertColumns(turned, weight, lowerStart, patch.rows, down, within(progress, 0.9, 1), ring.row);
    smoothMap(ring.row, kSmoothUp);
    ring.top = lens.latitude + (up - upperEnd) * kRadiansPerDegree / kMapPixelsPerDegree;
    return ring;
}

} // namespace shoal::panorama
