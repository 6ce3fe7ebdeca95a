// The two networks of MediaPipe Hands: a detector of palms, and the landmarks of the hand in a square around
// one. Zhang et al. 2020, "MediaPipe Hands: On-device Real-time Hand Tracking".
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Hidden.h"
#include "engine/core/Result.h"

#include <glm/vec3.hpp>
#include <opencv2/core.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct xnn_runtime;

namespace shoal::hands {

// Landmarks in the networks' order: the wrist, then four of each finger from the thumb on, root to tip.
constexpr int kLandmarkCount = 21;

// A square in a picture, pixels. turn: radians from upright, clockwise in the picture.
struct Crop {
    cv::Point2f middle;
    float size = 0, turn = 0;
};

struct FoundPalm {
    Crop hand; // around the whole hand
    cv::Rect2f box;
    float score = 0; // 0 to 1
};

struct Landmarks {
    std::array<cv::Point2f, kLandmarkCount> at; // pixels of the picture
    // Shape of the hand in the network's metres, from the hand's middle: x right and y down in the picture, z
    // away from the camera.
    std::array<glm::vec3, kLandmarkCount> shape;
    float presence = 0, right = 0; // 0 to 1: confidence that there is a hand, and that it is a right one
};

// Returns the square in which to look for the hand in the next picture.
Crop cropAround(const Landmarks& hand);

// A convolutional network, read from a TensorFlow Lite file and run by XNNPACK on the calling thread.
struct NeuralNet {
    // Reads a file whose checksum was verified before; its contents are not checked. name: for the error.
    static Result<NeuralNet> read(std::span<const uint8_t> tfLite, const std::string& name);

    bool run();

    // XNNPACK reads a little beyond the ends of arrays: all are longer than the file says.
    std::vector<float> input;                         // to be filled before run(): rows of pixels of channels
    std::vector<std::vector<float>> outputs, weights; // in the file's order
    Hidden<xnn_runtime> runtime{nullptr, nullptr};    // last: it uses all of the above
};

class HandNets {
  public:
    // Reads the files that get_models puts into a folder, and no other versions.
    static Result<HandNets> load(const Path& folder);

    // Returns palms, the surest first; valid until the next call. bgr: 8 bits, not empty.
    std::span<const FoundPalm> findPalms(const cv::Mat& bgr);
    Landmarks findLandmarks(const cv::Mat& bgr, const Crop& crop);

  private:
    HandNets() = default;
    void takePicture(const cv::Mat& bgr, const cv::Matx23f& inputFromPicture, int size, int border,
                     NeuralNet& net);

    NeuralNet palms_, landmarks_;
    std::vector<cv::Point2f> anchors_;
    // Scratch memory.
    cv::Mat small_, part_, rgb_;
    std::vector<FoundPalm> found_;
};

} // namespace shoal::hands
