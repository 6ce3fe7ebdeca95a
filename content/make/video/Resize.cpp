#include "content/make/video/Resize.h"

#include <algorithm>
#include <cmath>

namespace shoal::reef {

ImageRgbF reduced(const ImageRgbF& in, int width) {
    const int height = width / 2;
    ImageRgbF out(width, height);
    const float scale = static_cast<float>(in.width) / static_cast<float>(width);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float left = static_cast<float>(x) * scale, top = static_cast<float>(y) * scale;
            for (int j = static_cast<int>(top); static_cast<float>(j) < top + scale && j < in.height; ++j)
                for (int i = static_cast<int>(left); static_cast<float>(i) < left + scale && i < in.width;
                     ++i) {
                    const auto overlap = [&](int texel, float start) {
                        return std::max(std::min(static_cast<float>(texel + 1), start + scale) -
                                            std::max(static_cast<float>(texel), start),
                                        0.0f) /
                               scale;
                    };
                    for (int c = 0; c < 3; ++c)
                        out.at(x, y)[c] += overlap(i, left) * overlap(j, top) * in.at(i, j)[c];
                }
        }
    return out;
}

} // namespace shoal::reef
