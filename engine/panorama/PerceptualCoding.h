// Conversion between pictures and the perceptually coded matrices that this folder computes on: 3 floats a
// pixel, red first.
#pragma once

#include "engine/core/Image.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::panorama {

inline cv::Mat viewOf(const ImageRgb8& picture) {
    return {picture.height, picture.width, CV_8UC3, const_cast<uint8_t*>(picture.pixels.data())};
}
inline cv::Mat viewOf(const ImageRgbF& picture) {
    return {picture.height, picture.width, CV_32FC3, const_cast<float*>(picture.pixels.data())};
}

// Radiance by a power up to 1 and by a logarithm above, which meet in value and slope: a sun 10^5 times as
// bright as white does not drown what it is blended with.
inline float codedFromRadiance(float linear) {
    return linear <= 1 ? std::pow(std::max(linear, 0.0f), 1 / 2.2f) : 1 + std::log(linear) / 2.2f;
}
inline float radianceFromCoded(float coded) {
    return coded <= 1 ? std::pow(std::max(coded, 0.0f), 2.2f) : std::exp((coded - 1) * 2.2f);
}

// 8 bits are coded already; floats are linear radiance.
inline cv::Mat codedFrom(const cv::Mat& picture) {
    cv::Mat coded;
    if (picture.depth() == CV_8U) {
        picture.convertTo(coded, CV_32F, 1 / 255.0);
        return coded;
    }
    coded = picture.clone();
    std::transform(coded.begin<cv::Vec3f>(), coded.end<cv::Vec3f>(), coded.begin<cv::Vec3f>(),
                   [](const cv::Vec3f& c) -> cv::Vec3f {
                       return {codedFromRadiance(c[0]), codedFromRadiance(c[1]), codedFromRadiance(c[2])};
                   });
    return coded;
}

template <class Picture> Picture pictureFromCoded(const cv::Mat& coded) {
    Picture out(coded.cols, coded.rows);
    cv::Mat to = viewOf(out);
    if (to.depth() == CV_8U)
        coded.convertTo(to, CV_8U, 255);
    else
        std::transform(coded.begin<cv::Vec3f>(), coded.end<cv::Vec3f>(), to.begin<cv::Vec3f>(),
                       [](const cv::Vec3f& c) -> cv::Vec3f {
                           return {radianceFromCoded(c[0]), radianceFromCoded(c[1]), radianceFromCoded(c[2])};
                       });
    return out;
}

} // namespace shoal::panorama
