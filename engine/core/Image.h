// Pictures in memory: rows from the top, pixels interleaved, no padding between rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shoal {

template <class T, int kChannels> struct Image {
    static constexpr int channels = kChannels;
    int width = 0;
    int height = 0;
    std::vector<T> pixels; // width * height * channels

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * h * kChannels) {}

    // Resizes the picture and sets it to 0; does nothing if it has this size.
    void fit(int w, int h) {
        if (width != w || height != h) *this = Image(w, h);
    }

    bool empty() const { return pixels.empty(); }
    T* at(int x, int y) { return pixels.data() + (static_cast<size_t>(y) * width + x) * kChannels; }
    const T* at(int x, int y) const {
        return pixels.data() + (static_cast<size_t>(y) * width + x) * kChannels;
    }
};

using ImageRgb8 = Image<uint8_t, 3>;  // sRGB-coded
using ImageRgba8 = Image<uint8_t, 4>; // sRGB-coded colour, straight linear alpha, unless named otherwise
using ImageRgbF = Image<float, 3>;    // linear radiance, Rec. 709 primaries
using ImageF = Image<float, 1>;

} // namespace shoal
