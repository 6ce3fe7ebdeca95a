#include "content/make/depth/FilmFrames.h"

#include <algorithm>

namespace shoal::depth {

int FilmFrames::trackCount() const {
    return static_cast<int>(std::max<int64_t>(info_.frameCount / kFilmStep, 1));
}

light::FrameView FilmFrames::eye(int64_t filmFrame, int eye) {
    const media::VideoFrame& frame = *player_.waitFor((static_cast<double>(filmFrame) + 0.25) / info_.fps);
    const ImageRgb8& pixels = frame.pixelsBgr;
    const media::EyePart part = media::eyePart(frame.layout, eye, pixels.width, pixels.height);
    return {pixels.at(part.x, part.y), part.width, part.height, static_cast<ptrdiff_t>(pixels.width) * 3,
            true};
}

} // namespace shoal::depth
