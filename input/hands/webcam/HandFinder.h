// What a webcam's tracker asks of a method that finds hands in pictures.
#pragma once

#include "input/hands/HandTracker.h"

#include <opencv2/core.hpp>

#include <span>

namespace shoal::hands {

// Typical of webcams, which do not report it. An error in it scales all distances alike.
constexpr float kWebcamFov = 1.05f; // horizontal, radians

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
