#include "engine/panorama/SeamInsertion.h"

#include <opencv2/imgproc.hpp>

#include <cassert>
#include <cstdint>

namespace shoal::panorama {

namespace {

struct Widened {
    Colours colours;
    Plane weight;
    Plane source;
};

// 1 for the pixels of the `count` seams that are successively the cheapest to remove.
Image<uint8_t, 1> seamsToDouble(const Widened& now, int count, const std::function<void()>& found) {
    Colours colours = now.colours;
    Plane weight = now.weight;
    Image<int, 1> column(colours.width, colours.height);
    for (int y = 0; y < column.height; ++y)
        for (int x = 0; x < column.width; ++x) *column.at(x, y) = x;
    Image<uint8_t, 1> chosen(colours.width, colours.height);
    for (int k = 0; k < count; ++k) {
        const std::vector<int> seam = minSeam(colours, weight);
        for (int y = 0; y < column.height; ++y)
            *chosen.at(*column.at(seam[static_cast<size_t>(y)], y), y) = 1;
        removeSeam(colours, seam);
        removeSeam(weight, seam);
        removeSeam(column, seam);
        found();
    }
    return chosen;
}

// Inserts after each chosen pixel the mean of it and the next.
template <int kChannels>
Image<float, kChannels> doubled(const Image<float, kChannels>& in, const Image<uint8_t, 1>& chosen,
                                int count) {
    Image<float, kChannels> out(in.width + count, in.height);
    for (int y = 0; y < in.height; ++y) {
        float* to = out.at(0, y);
        for (int x = 0; x < in.width; ++x) {
            const float* here = in.at(x, y);
            const float* next = in.at(std::min(x + 1, in.width - 1), y);
            to = std::copy(here, here + kChannels, to);
            if (*chosen.at(x, y))
                for (int c = 0; c < kChannels; ++c) *to++ = 0.5f * (here[c] + next[c]);
        }
    }
    return out;
}

// Mean difference of a pixel from its right neighbour: the scale of the energies.
float meanStep(const Colours& colours) {
    double sum = 0;
    for (int y = 0; y < colours.height; ++y)
        for (int i = 0; i < 3 * (colours.width - 1); ++i)
            sum += std::abs(static_cast<double>(colours.at(0, y)[i + 3]) -
                            static_cast<double>(colours.at(0, y)[i]));
    return static_cast<float>(sum / (static_cast<double>(colours.width) * colours.height));
}

} // namespace

Plane seamInsertionMap(const Colours& colours, const Plane& weight, int columns, const Progress& progress) {
    assert(columns >= colours.width && weight.width == colours.width && weight.height == colours.height);
    constexpr float kDoubledWeight = 0.4f; // added to doubled pixels, in mean steps
    constexpr float kMinWeight = 1e-4f;    // spreads insertions where the picture is flat
    const float doubledWeight = kDoubledWeight * meanStep(colours) + kMinWeight;

    Widened now{colours, weight, Plane(colours.width, colours.height)};
    for (int y = 0; y < now.source.height; ++y)
        for (int x = 0; x < now.source.width; ++x) *now.source.at(x, y) = static_cast<float>(x);
    const int wanted = columns - colours.width;
    int done = 0;
    while (done < wanted) {
        const int width = now.colours.width;
        const int count = std::min(wanted - done, std::max(1, width / 10));
        const Image<uint8_t, 1> chosen = seamsToDouble(now, count, [&, k = 0]() mutable {
            if (progress) progress(static_cast<double>(done + ++k) / wanted);
        });
        for (size_t i = 0; i < chosen.pixels.size(); ++i)
            if (chosen.pixels[i]) now.weight.pixels[i] += doubledWeight;
        now.colours = doubled(now.colours, chosen, count);
        now.weight = doubled(now.weight, chosen, count);
        now.source = doubled(now.source, chosen, count);
        done += count;
    }
    return now.source;
}

std::vector<float> columnInsertionMap(const Colours& colours, const Plane& weight, int columns,
                                      const Progress& progress) {
    Plane map = seamInsertionMap(colours, weight, columns, progress);
    cv::Mat mean;
    cv::reduce(cv::Mat(map.height, map.width, CV_32F, map.pixels.data()), mean, 0, cv::REDUCE_AVG);
    return {mean.begin<float>(), mean.end<float>()};
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
