// What a webcam's tracker asks of a method that finds hands in pictures.
#pragma once

#include "input/hands/HandTracker.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <span>

namespace shoal::hands {

// Typical of webcams, which do not report it. An error in it scales all distances alike.
constexpr float kWebcamFov = 1.05f; // horizontal, radians

// By how much pictures are to be made brighter so that hands are seen in the dark; else 1.
inline double gainFor(const cv::Mat& bgr) {
    constexpr double kDark = 70, kBright = 110, kMaxGain = 6; // of a picture's mean, of 255
    const cv::Scalar mean = cv::mean(bgr);
    const double light = (mean[0] + mean[1] + mean[2]) / 3;
    return light < kDark ? std::min(kBright / std::max(light, 1.0), kMaxGain) : 1.0;
}

class HandFinder {
  public:
    virtual ~HandFinder() = default;

    // The next picture, blue first, of any size. time_s rises. Hands are returned in the camera's frame.
    virtual HandFrame detect(const cv::Mat& bgr, double time_s) = 0;
    // Where the last picture shows hands, its pixels; for a person to see.
    virtual std::span<const cv::Point2f> marks() const { return {}; }
    virtual Instruction instruction() const { return Instruction::None; } // for the player
};

} // namespace shoal::hands
