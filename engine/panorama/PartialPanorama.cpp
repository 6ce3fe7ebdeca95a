#include "engine/panorama/FindLight.h"
#include "engine/panorama/Panorama.h"
#include "engine/panorama/PerceptualCoding.h"
#include "engine/panorama/PolarCaps.h"

#include <opencv2/imgproc.hpp>

#include <cassert>
#include <cmath>

namespace shoal::panorama {

namespace {

// The column `steps` beyond the end of a picture that is repeated mirrored.
int mirrored(int steps, int size) {
    const int at = steps % (2 * size);
    return at < size ? at : 2 * size - 1 - at;
}

// Fills the columns from right to left + width (exclusive), between two ends of the same picture.
void fillGap(cv::Mat& rows, int left, int right) {
    const int gap = left + rows.cols - right;
    // Mirrored only up to the light, so that it is not repeated.
    const double light = findMainLight(rows.colRange(left, right)).place.x;
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

cv::Mat completed(const cv::Mat& photo, const PanoramaPart& part, int width) {
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
    if (top > 0) fillPolarCap(sphere, top, PolarCap::Sky);
    cv::flip(sphere, sphere, 0);
    if (bottom < height) fillPolarCap(sphere, height - bottom, PolarCap::Ground);
    cv::flip(sphere, sphere, 0);
    return sphere;
}

template <class Picture> Result<Picture> completeAny(const Picture& photo, const PanoramaPart& part) {
    assert(part.left < part.right && part.top < part.bottom && part.left >= 0 && part.top >= 0 &&
           part.right <= 1 && part.bottom <= 1);
    const double whole = photo.width / (part.right - part.left);
    const int width = static_cast<int>(std::clamp(whole, 512.0, 4096.0)) / 64 * 64;
    if ((part.right - part.left) * width < 2 || (part.bottom - part.top) * width / 2 < 2)
        return Error{"", "the part of the environment that it says it is, is too small to be shown"};
    cv::Mat bounded = viewOf(photo);
    if (photo.width > width)
        cv::resize(bounded, bounded, {width, std::max(1, std::min(photo.height, width))}, 0, 0,
                   cv::INTER_AREA);
    return pictureFromCoded<Picture>(completed(codedFrom(bounded), part, width));
}

} // namespace

Result<ImageRgb8> completePanorama(const ImageRgb8& photo, const PanoramaPart& part) {
    return completeAny(photo, part);
}
Result<ImageRgbF> completePanorama(const ImageRgbF& radianceLin, const PanoramaPart& part) {
    return completeAny(radianceLin, part);
}

} // namespace shoal::panorama
