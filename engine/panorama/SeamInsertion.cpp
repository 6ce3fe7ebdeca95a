#include "engine/panorama/SeamInsertion.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace shoal::panorama {

namespace {

struct Widened {
    cv::Mat colours, weight, source;
};

float difference(const float* a, const float* b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// Returns the source columns of an unchanged picture.
cv::Mat columnNumbers(const cv::Size& size) {
    cv::Mat numbers(size, CV_32F);
    for (int x = 0; x < size.width; ++x) numbers.col(x).setTo(x);
    return numbers;
}

// Removes one pixel a row, in the matrix' own memory.
void removeSeam(cv::Mat& image, const std::vector<int>& seam) {
    const size_t pixel = image.elemSize();
    for (int y = 0; y < image.rows; ++y) {
        const int x = seam[y];
        uint8_t* at = image.ptr(y, x);
        std::memmove(at, at + pixel, static_cast<size_t>(image.cols - 1 - x) * pixel);
    }
    image = image.colRange(0, image.cols - 1);
}

// Marks the pixels of the `count` seams that are successively the cheapest to remove.
cv::Mat seamsToDouble(const Widened& now, int count, const std::function<void()>& found) {
    cv::Mat colours = now.colours.clone(), weight = now.weight.clone();
    cv::Mat column = columnNumbers(colours.size()), chosen(colours.size(), CV_8U, cv::Scalar(0));
    for (int k = 0; k < count; ++k) {
        const std::vector<int> seam = minSeam(colours, weight);
        for (int y = 0; y < column.rows; ++y)
            chosen.at<uint8_t>(y, static_cast<int>(column.at<float>(y, seam[y]))) = 1;
        for (cv::Mat* each : {&colours, &weight, &column}) removeSeam(*each, seam);
        found();
    }
    return chosen;
}

// Inserts after each chosen pixel the mean of it and the next.
cv::Mat doubled(const cv::Mat& in, const cv::Mat& chosen, int count) {
    cv::Mat out(in.rows, in.cols + count, in.type());
    const int channels = in.channels();
    for (int y = 0; y < in.rows; ++y) {
        float* to = out.ptr<float>(y);
        for (int x = 0; x < in.cols; ++x) {
            const float* here = in.ptr<float>(y, x);
            const float* next = in.ptr<float>(y, std::min(x + 1, in.cols - 1));
            to = std::copy(here, here + channels, to);
            if (chosen.at<uint8_t>(y, x))
                for (int c = 0; c < channels; ++c) *to++ = 0.5f * (here[c] + next[c]);
        }
    }
    return out;
}

// Returns the mean difference of a pixel from its right neighbour: the scale of the energies.
double meanStep(const cv::Mat& colours) {
    if (colours.cols < 2) return 0;
    return cv::norm(colours.colRange(1, colours.cols), colours.colRange(0, colours.cols - 1), cv::NORM_L1) /
           static_cast<double>(colours.total());
}

} // namespace

std::vector<int> minSeam(const cv::Mat& colours, const cv::Mat& weight) {
    const int w = colours.cols, h = colours.rows;
    assert(w > 0 && h > 0 && weight.size() == colours.size());
    constexpr float kNever = std::numeric_limits<float>::max();

    // Minimum cost of a seam down to each pixel of a row, with a sentinel at each end, and its predecessor.
    std::vector<float> above(w + 2, kNever), here(w + 2, kNever);
    std::vector<float> apart(w), turnLeft(w), turnRight(w);
    cv::Mat from(h, w, CV_8S, cv::Scalar(0));
    for (int y = 0; y < h; ++y) {
        const float* row = colours.ptr<float>(y);
        const float* over = colours.ptr<float>(std::max(y - 1, 0));
        for (int x = 0; x < w; ++x) {
            const float* left = row + 3 * std::max(x - 1, 0);
            const float* right = row + 3 * std::min(x + 1, w - 1);
            apart[x] = difference(left, right) + weight.at<float>(y, x);
            turnLeft[x] = difference(over + 3 * x, left);
            turnRight[x] = difference(over + 3 * x, right);
        }
        if (y == 0) {
            std::copy(apart.begin(), apart.end(), here.begin() + 1);
        } else {
            int8_t* cameFrom = from.ptr<int8_t>(y);
            for (int x = 0; x < w; ++x) {
                const float l = above[x] + turnLeft[x], u = above[x + 1], r = above[x + 2] + turnRight[x];
                const float minimum = std::min(std::min(l, u), r);
                cameFrom[x] = static_cast<int8_t>(u == minimum ? 0 : l == minimum ? -1 : 1);
                here[x + 1] = minimum + apart[x];
            }
        }
        std::swap(above, here);
    }

    std::vector<int> seam(h);
    int x = static_cast<int>(std::min_element(above.begin() + 1, above.end() - 1) - above.begin()) - 1;
    for (int y = h - 1; y >= 0; --y) {
        seam[y] = x;
        x += from.at<int8_t>(y, x);
    }
    return seam;
}

cv::Mat seamInsertionMap(const cv::Mat& colours, const cv::Mat& weight, int columns,
                         const Progress& progress) {
    assert(columns >= colours.cols && weight.size() == colours.size());
    constexpr double kDoubledWeight = 0.4; // added to doubled pixels, in mean steps
    constexpr double kMinWeight = 1e-4;    // spreads insertions where the picture is flat
    const double doubledWeight = kDoubledWeight * meanStep(colours) + kMinWeight;

    Widened now{colours, weight.clone(), columnNumbers(colours.size())};
    const int wanted = columns - colours.cols;
    int done = 0;
    while (done < wanted) {
        const int count = std::min(wanted - done, std::max(1, now.colours.cols / 10));
        const cv::Mat chosen =
            seamsToDouble(now, count, [&] { progress(static_cast<double>(++done) / wanted); });
        cv::add(now.weight, doubledWeight, now.weight, chosen);
        for (cv::Mat* each : {&now.colours, &now.weight, &now.source}) *each = doubled(*each, chosen, count);
    }
    return now.source;
}

void smoothMap(std::vector<float>& map, double sigma_px) {
    if (map.size() < 2) return;
    const float first = map.front(), last = map.back();
    const auto straight = [&](size_t k, float from, float to) {
        return from + (to - from) * static_cast<float>(k) / static_cast<float>(map.size() - 1);
    };
    cv::Mat rest(1, static_cast<int>(map.size()), CV_32F, map.data());
    for (size_t k = 0; k < map.size(); ++k) map[k] -= straight(k, first, last);
    cv::GaussianBlur(rest, rest, {}, sigma_px, 0.1, cv::BORDER_REFLECT);
    const float atFirst = map.front(), atLast = map.back();
    float minimum = first;
    for (size_t k = 0; k < map.size(); ++k) {
        const float placed = straight(k, first, last) + map[k] - straight(k, atFirst, atLast);
        map[k] = minimum = std::clamp(placed, minimum, std::max(minimum, last));
    }
}

} // namespace shoal::panorama
