#include "engine/panorama/Place.h"

#include "engine/panorama/Caps.h"
#include "engine/panorama/Coded.h"
#include "engine/panorama/FindLight.h"

#include <opencv2/imgproc.hpp>

#include <cassert>
#include <cmath>

namespace shoal::panorama {

namespace {

// Which of `size` columns lies `steps` beyond the end, if the picture goes on as in a row of mirrors.
int mirrored(int steps, int size) {
    const int at = steps % (2 * size);
    return at < size ? at : 2 * size - 1 - at;
}

// Columns from right to left + width (exclusive) of each row, between two ends of the same picture.
void fillGap(cv::Mat& rows, int left, int right) {
    const int gap = left + rows.cols - right;
    // The mirrors stand before the light: there is to be one only.
    cv::Mat small;
    cv::resize(rows.colRange(left, right), small, {256, std::max(1, rows.rows * 256 / (right - left))}, 0, 0,
               cv::INTER_AREA);
    const double light = findLight(small).place.x / 256 * (right - left);
    const auto depth = [&](double toLight) { return std::max(1, static_cast<int>(0.7 * toLight)); };
    const int depthLeft = depth(light), depthRight = depth(right - left - light);
    for (int k = 0; k < gap; ++k) {
        const double t = (k + 0.5) / gap;
        const double fromLeft = t * t * (3 - 2 * t); // the left end lies to the right of the gap
        cv::Mat to = rows.col((right + k) % rows.cols);
        cv::addWeighted(rows.col(right - 1 - mirrored(k, depthRight)), 1 - fromLeft,
                        rows.col(left + mirrored(gap - 1 - k, depthLeft)), fromLeft, 0, to);
    }
}

cv::Mat placed(const cv::Mat& photo, const Part& part, int width) {
    const int height = width / 2;
    const auto pixel = [](double share, int size) { return static_cast<int>(std::lround(share * size)); };
    const int left = pixel(part.left, width), right = pixel(part.right, width);
    int top = pixel(part.top, height), bottom = pixel(part.bottom, height);
    cv::Mat sphere = cv::Mat::zeros(height, width, CV_32FC3), resized;
    const bool smaller = right - left < photo.cols || bottom - top < photo.rows;
    cv::resize(photo, resized, {right - left, bottom - top}, 0, 0,
               smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    resized.copyTo(sphere(cv::Rect(left, top, right - left, bottom - top)));
    cv::Mat rows = sphere.rowRange(top, bottom);
    if (right - left < width) fillGap(rows, left, right);
    // Sky and ground each reach up to the horizon at most.
    for (; top >= height / 2; --top) sphere.row(top).copyTo(sphere.row(top - 1));
    for (; bottom <= height / 2; ++bottom) sphere.row(bottom - 1).copyTo(sphere.row(bottom));
    if (top > 0) fillCap(sphere, top, Cap::Sky);
    cv::flip(sphere, sphere, 0);
    if (bottom < height) fillCap(sphere, height - bottom, Cap::Ground);
    cv::flip(sphere, sphere, 0);
    return sphere;
}

template <class Picture> Result<Picture> placeAny(const Picture& photo, const Part& part) {
    assert(part.left < part.right && part.top < part.bottom && part.left >= 0 && part.top >= 0 &&
           part.right <= 1 && part.bottom <= 1);
    const double whole = photo.width / (part.right - part.left);
    const int width = static_cast<int>(std::clamp(whole, 512.0, 4096.0)) / 64 * 64;
    if ((part.right - part.left) * width < 2 || (part.bottom - part.top) * width / 2 < 2)
        return Error{"", "the part of the surround that it says it is, is too small to be shown"};
    cv::Mat bounded = viewOf(photo);
    if (photo.width > width)
        cv::resize(bounded, bounded, {width, std::max(1, std::min(photo.height, width))}, 0, 0,
                   cv::INTER_AREA);
    return pictureFrom<Picture>(placed(codedFrom(bounded), part, width));
}

} // namespace

Result<ImageRgb8> place(const ImageRgb8& photo, const Part& part) { return placeAny(photo, part); }
Result<ImageRgbF> place(const ImageRgbF& radianceLin, const Part& part) {
    return placeAny(radianceLin, part);
}

} // namespace shoal::panorama
