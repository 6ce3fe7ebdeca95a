#include "engine/media/Orientation.h"

#include <fmt/core.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace shoal::media {

template <class Picture> static cv::Mat viewOf(const Picture& picture, const EyePart& part) {
    using Value = typename decltype(picture.pixels)::value_type;
    const void* pixels = picture.pixels.data();
    const cv::Mat whole(picture.height, picture.width, CV_MAKETYPE(cv::DataType<Value>::depth, 3),
                        const_cast<void*>(pixels));
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
    constexpr int kFlips[] = {1, -1, 0}; // after the transposition: left and right, both, upside down
    if (const int step = (known - 1) % 4; step > 0) cv::flip(to, to, kFlips[step - 1]);
}

std::string uprightNote(int orientation) {
    return fmt::format("; turned upright from its orientation {}", orientation);
}

int orientationOf(std::span<const int32_t, 9> matrix) {
    const int64_t a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
    const bool across = std::abs(b) + std::abs(c) > std::abs(a) + std::abs(d);
    const bool leftRight = (across ? c : a) < 0, upsideDown = (across ? b : d) < 0;
    return (across ? 5 : 1) + (leftRight ? (upsideDown ? 2 : 1) : upsideDown ? 3 : 0);
}

template <class Picture>
void placeInSphere(const Picture& upright, Layout layout, const SphereBounds& bounds, Picture& whole) {
    const auto part = [](int of, double share) { return static_cast<int>(std::lround(of * share)); };
    for (const int eye : {0, 1}) {
        cv::Mat from = viewOf(upright, eyePart(layout, eye, upright.width, upright.height));
        cv::Mat to = viewOf(whole, eyePart(layout, eye, whole.width, whole.height));
        if (from.empty() || to.empty()) continue; // half of a single row
        const cv::Size size(std::max(part(to.cols, bounds.width()), 1),
                            std::max(part(to.rows, bounds.height()), 1));
        if (from.size() != size) cv::resize(from, from, size, 0, 0, cv::INTER_AREA);
        const int left = std::min(part(to.cols, bounds.left), to.cols - size.width);
        const int top = std::min(part(to.rows, bounds.top), to.rows - size.height);
        cv::copyMakeBorder(from, to, top, to.rows - top - size.height, left, to.cols - left - size.width,
                           cv::BORDER_REFLECT | cv::BORDER_ISOLATED);
    }
}

template void makeUpright(const ImageRgb8&, int, ImageRgb8&);
template void makeUpright(const ImageRgbF&, int, ImageRgbF&);
template void placeInSphere(const ImageRgb8&, Layout, const SphereBounds&, ImageRgb8&);
template void placeInSphere(const ImageRgbF&, Layout, const SphereBounds&, ImageRgbF&);

} // namespace shoal::media
