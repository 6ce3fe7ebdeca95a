// Grey values of a frame, which optical flow and stereo compare.
#pragma once

#include "engine/light/FrameView.h"

#include <opencv2/imgproc.hpp>

namespace shoal::depth {

// out: width x width / 2 pixels, with `padding` more columns at each side, copied from beyond the seam.
inline void greyOf(const light::FrameView& film, int width, int padding, cv::Mat1b& out) {
    const cv::Mat3b source(film.height, film.width,
                           reinterpret_cast<cv::Vec3b*>(const_cast<uint8_t*>(film.pixels)),
                           static_cast<size_t>(film.rowStride));
    cv::Mat1b grey;
    cv::cvtColor(source, grey, film.bgr ? cv::COLOR_BGR2GRAY : cv::COLOR_RGB2GRAY);
    cv::resize(grey, grey, {width, width / 2}, 0, 0, film.width > width ? cv::INTER_AREA : cv::INTER_LINEAR);
    cv::copyMakeBorder(grey, out, 0, 0, padding, padding, cv::BORDER_WRAP);
}

} // namespace shoal::depth
