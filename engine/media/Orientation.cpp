#include "engine/media/Orientation.h"

#include <opencv2/core.hpp>

#include <cstdlib>

namespace shoal::media {

template <class Picture> void makeUpright(const Picture& stored, int orientation, Picture& upright) {
    const int known = orientation >= 1 && orientation <= 8 ? orientation : 1;
    const bool across = swapsSides(known);
    upright.fit(across ? stored.height : stored.width, across ? stored.width : stored.height);
    if (stored.empty()) return;
    const auto viewOf = [](const Picture& picture) {
        const int type = CV_MAKETYPE(cv::DataType<std::decay_t<decltype(picture.pixels[0])>>::depth, 3);
        return cv::Mat(picture.height, picture.width, type,
                       const_cast<void*>(static_cast<const void*>(picture.pixels.data())));
    };
    const cv::Mat from = viewOf(stored);
    cv::Mat to = viewOf(upright);
    across ? cv::transpose(from, to) : from.copyTo(to);
    constexpr int kLeftRight = 1, kBoth = -1, kUpsideDown = 0; // as cv::flip() counts
    constexpr int kFlips[] = {kLeftRight, kBoth, kUpsideDown}; // after the transposition
    if (const int step = (known - 1) % 4; step > 0) cv::flip(to, to, kFlips[step - 1]);
}

template void makeUpright(const ImageRgb8&, int, ImageRgb8&);
template void makeUpright(const ImageRgbF&, int, ImageRgbF&);

int orientationOf(std::span<const int32_t, 9> matrix) {
    const int64_t a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
    const bool across = std::abs(b) + std::abs(c) > std::abs(a) + std::abs(d);
    const bool leftRight = (across ? c : a) < 0, upsideDown = (across ? b : d) < 0;
    return (across ? 5 : 1) + (leftRight ? (upsideDown ? 2 : 1) : upsideDown ? 3 : 0);
}

} // namespace shoal::media
