#include "engine/media/StereoView.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace shoal::media {

namespace {

constexpr int kWidth = 128, kHeight = 64, kBlock = 8; // size of a half, and side of a block, in cells
constexpr int kMaxShift = 6;     // cells to either side: 17 degrees, twice the disparity at arm's length
constexpr double kStructure = 3; // least standard deviation along a block's rows, in levels of 255
// The least correlation of a block with the other half, and the least share of structured blocks with it: two
// stereo pictures at hand have 97 %, a room that repeats itself 76 %, ten other panoramas at most 14 %.
constexpr double kAlike = 0.7, kOfStructured = 0.9;
constexpr int kMinStructured = 12; // least number of structured blocks, of 128: fewer tell nothing

// Returns the brightness of a part of the frame, by cell. Columns go on for kMaxShift cells at both ends.
cv::Mat brightnessOf(const cv::Mat& frame, const cv::Rect& part) {
    constexpr int kSamples = 4; // samples of a cell in each direction, whatever the frame's size
    cv::Mat samples, cells, brightness;
    cv::resize(frame(part), samples, {kWidth * kSamples, kHeight * kSamples}, 0, 0, cv::INTER_NEAREST);
    samples.convertTo(samples, CV_32F);
    cv::resize(samples, cells, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
    cv::transform(cells, brightness, cv::Matx13f(1 / 3.0f, 1 / 3.0f, 1 / 3.0f));
    cv::copyMakeBorder(brightness, brightness, 0, 0, kMaxShift, kMaxShift, cv::BORDER_WRAP);
    return brightness;
}

// Returns a block with each row minus its mean: the gradient of a sky or of water is no structure.
cv::Mat blockAt(const cv::Mat& half, int x, int y) {
    const cv::Mat block = half({x + kMaxShift, y, kBlock, kBlock});
    cv::Mat means;
    cv::reduce(block, means, 1, cv::REDUCE_AVG);
    return block - cv::repeat(means, 1, kBlock);
}

enum class Halves { Unlike, Alike, Unstructured };

// Returns whether one half's blocks are found in the other, each with its own shift: near things shift more.
Halves compare(const cv::Mat& a, const cv::Mat& b) {
    constexpr double kMinVariance = kStructure * kStructure * kBlock * kBlock;
    int structured = 0, found = 0;
    for (int y = 0; y < kHeight; y += kBlock)
        for (int x = 0; x < kWidth; x += kBlock) {
            const cv::Mat block = blockAt(a, x, y);
            const double own = block.dot(block);
            if (own < kMinVariance) continue;
            ++structured;
            double best = 0;
            for (int shift = -kMaxShift; shift <= kMaxShift; ++shift) {
                const cv::Mat other = blockAt(b, x + shift, y);
                const double others = other.dot(other);
                if (others >= kMinVariance / 4)
                    best = std::max(best, block.dot(other) / std::sqrt(own * others));
            }
            found += best >= kAlike;
        }
    if (structured < kMinStructured) return Halves::Unstructured;
    return found >= kOfStructured * structured ? Halves::Alike : Halves::Unlike;
}

} // namespace

EyePart eyePart(Layout layout, int eye, int width, int height) {
    assert(layout != Layout::Auto && (eye == 0 || eye == 1));
    if (layout == Layout::BottomTop || layout == Layout::RightLeft) eye = 1 - eye;
    if (layout == Layout::TopBottom || layout == Layout::BottomTop)
        return {0, eye * height / 2, width, height / 2};
    if (layout == Layout::LeftRight || layout == Layout::RightLeft)
        return {eye * width / 2, 0, width / 2, height};
    return {0, 0, width, height};
}

Layout layoutFromShape(double width, double height) {
    const double aspect = width / height;
    const auto near = [&](double wanted) { return std::abs(aspect / wanted - 1) < 0.06; };
    if (near(2)) return Layout::Mono;
    if (near(1)) return Layout::TopBottom;
    if (near(4)) return Layout::LeftRight;
    return Layout::Auto;
}

Layout layoutFromContent(const ImageRgb8& frame) {
    const int w = frame.width, h = frame.height;
    if (w < 2 || h < 2) return Layout::Auto;
    const cv::Mat view(h, w, CV_8UC3, const_cast<uint8_t*>(frame.pixels.data()));
    const auto halves = [&](const cv::Size& half) {
        return compare(brightnessOf(view, {{0, 0}, half}),
                       brightnessOf(view, {{w - half.width, h - half.height}, half}));
    };
    const Halves vertical = halves({w, h / 2}), horizontal = halves({w / 2, h});
    if (vertical == Halves::Alike && horizontal != Halves::Alike) return Layout::TopBottom;
    if (horizontal == Halves::Alike && vertical != Halves::Alike) return Layout::LeftRight;
    const bool nothing = vertical == Halves::Unstructured && horizontal == Halves::Unstructured;
    return nothing ? Layout::Auto : Layout::Mono;
}

Layout layoutOf(const ImageRgb8& picture) {
    const Layout shape = layoutFromShape(picture.width, picture.height);
    if (shape == Layout::Auto) return Layout::Auto;
    const Layout content = layoutFromContent(picture);
    if (shape != Layout::Mono) return content == shape ? shape : Layout::Auto;
    return content == Layout::Auto ? Layout::Mono : content;
}

Layout layoutOf(const ImageRgbF& picture) {
    const Layout shape = layoutFromShape(picture.width, picture.height);
    return shape == Layout::Mono ? shape : Layout::Auto;
}

} // namespace shoal::media
