#include "engine/media/Orientation.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace shoal::media {

template <class Picture> static cv::Mat viewOf(const Picture& picture, const EyePart& part) {
    const int type = CV_MAKETYPE(cv::DataType<std::remove_cvref_t<decltype(picture.pixels[0])>>::depth, 3);
    const void* pixels = picture.pixels.data();
    const cv::Mat whole(picture.height, picture.width, type, const_cast<void*>(pixels));
    return whole({part.x, part.y, part.width, part.height});
}

template <class Picture> void makeUpright(const Picture& stored, int orientation, Picture& upright) {
    const int known = orientation >= 1 && orientation <= 8 ? orientation : 1;
    const bool across = swapsSides(known);
    upright.fit(across ? stored.height : stored.width, across ? stored.width : stored.height);
    if (stored.empty()) return;
    const cv::Mat from = viewOf(stored, {0, 0, stored.width, stored.height});
    cv::Mat to = viewOf(upright, {0, 0, upright.width, upright.height});
    across ? cv::transpose(from, to) : from.copyTo(to);
    constexpr int kLeftRight = 1, kBoth = -1, kUpsideDown = 0; // as cv::flip() counts
    constexpr int kFlips[] = {kLeftRight, kBoth, kUpsideDown}; // after the transposition
    if (const int step = (known - 1) % 4; step > 0) cv::flip(to, to, kFlips[step - 1]);
}

int orientationOf(std::span<const int32_t, 9> matrix) {
    const int64_t a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
    const bool across = std::abs(b) + std::abs(c) > std::abs(a) + std::abs(d);
    const bool leftRight = (across ? c : a) < 0, upsideDown = (across ? b : d) < 0;
    return (across ? 5 : 1) + (leftRight ? (upsideDown ? 2 : 1) : upsideDown ? 3 : 0);
}

PanoramaPlacement placementOf(const SphereBounds& bounds, int width, int height) {
    const auto fullWidth = static_cast<int>(std::lround(width / bounds.width()));
    const auto fullHeight = static_cast<int>(std::lround(height / bounds.height()));
    return {.fullWidth = fullWidth,
            .fullHeight = fullHeight,
            .left = std::min(static_cast<int>(std::lround(fullWidth * bounds.left)), fullWidth - width),
            .top = std::min(static_cast<int>(std::lround(fullHeight * bounds.top)), fullHeight - height),
            .width = width,
            .height = height};
}

template <class Picture>
void placeInSphere(const Picture& upright, Layout layout, const SphereBounds& bounds, Picture& whole) {
    const EyePart part = eyePart(layout, 0, upright.width, upright.height);
    const PanoramaPlacement p = placementOf(bounds, part.width, part.height);
    whole.fit(upright.width / part.width * p.fullWidth, upright.height / part.height * p.fullHeight);
    for (const int eye : {0, 1}) {
        const cv::Mat from = viewOf(upright, eyePart(layout, eye, upright.width, upright.height));
        cv::Mat to = viewOf(whole, eyePart(layout, eye, whole.width, whole.height));
        cv::copyMakeBorder(from, to, p.top, p.fullHeight - p.top - p.height, p.left,
                           p.fullWidth - p.left - p.width, cv::BORDER_REFLECT | cv::BORDER_ISOLATED);
    }
}

template void makeUpright(const ImageRgb8&, int, ImageRgb8&);
template void makeUpright(const ImageRgbF&, int, ImageRgbF&);
template void placeInSphere(const ImageRgb8&, Layout, const SphereBounds&, ImageRgb8&);
template void placeInSphere(const ImageRgbF&, Layout, const SphereBounds&, ImageRgbF&);

} // namespace shoal::media
