#include "content/make/depth/DepthPreview.h"

#include "content/make/depth/FrameRecord.h"
#include "engine/media/Pictures.h"

#include <algorithm>
#include <cmath>

namespace shoal::depth {

Status writePreview(const Path& file, const light::FrameView& film, const media::DepthFrame& depth) {
    constexpr int kWide = 768, kHigh = kWide / 2;
    ImageRgb8 picture(2 * kWide, kHigh);
    for (int y = 0; y < kHigh; ++y)
        for (int x = 0; x < kWide; ++x) {
            const uint8_t* pixel =
                film.pixels + y * film.height / kHigh * film.rowStride + x * film.width / kWide * 3;
            uint8_t* left = picture.at(x, y);
            left[0] = pixel[2], left[1] = pixel[1], left[2] = pixel[0];
            const int dx = x * kEstimateWidth / kWide, dy = y * kEstimateHeight / kHigh;
            const float grey = std::sqrt(std::min(depth.inverse_perM(dx, dy), 1.0f)) * 255;
            const auto sure = depth.confidence[static_cast<size_t>(dy / 2) * kEstimateWidth / 2 +
                                               static_cast<size_t>(dx / 2)];
            uint8_t* right = picture.at(kWide + x, y);
            const bool known = sure > media::kMaxDepthCode / 2;
            right[0] = right[1] = static_cast<uint8_t>(known ? grey : 0);
            right[2] = static_cast<uint8_t>(known ? grey : 90);
        }
    return media::writePicture(file, picture);
}

} // namespace shoal::depth
