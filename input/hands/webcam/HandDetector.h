// Detection of hands in the pictures of a webcam: segmentation by a colour that is calibrated on the player,
// and the geometry of outlines. No learned weights.
#pragma once

#include "input/hands/HandRig.h"
#include "input/hands/HandTracker.h"
#include "input/hands/webcam/HandOutlines.h"

#include <opencv2/core.hpp>

#include <optional>

namespace shoal::hands {

// Colour model of a player's hands, calibrated on a few pictures, for segmentation from the background.

// Histograms over chroma (Cr and Cb in 64 steps each) and, coarsely, lightness (Y in 8). What counts is how
// much commoner a colour is among the hand's pixels than among the background's: Jones and Rehg 1999,
// "Statistical Color Models with Application to Skin Detection", equation 3, with equal costs.
class SkinColour {
  public:
    void addBackground(const cv::Mat& ycc);                 // 8-bit YCrCb
    void addHand(const cv::Mat& ycc, const cv::Mat& where); // where: 8-bit mask
    void learn();
    bool learnt() const { return !likely_.empty(); }

    // 0 to 255 for each pixel; learn() comes before.
    void likelihood(const cv::Mat& ycc, cv::Mat& out) const;

  private:
    cv::Mat hand_ = cv::Mat::zeros(kBins, 1, CV_32F), background_ = cv::Mat::zeros(kBins, 1, CV_32F);
    cv::Mat likely_; // 8-bit, by bin
    static constexpr int kChroma = 64, kLight = 8, kBins = kLight * kChroma * kChroma;
    static int bin(const cv::Vec3b& ycc) {
        return ((ycc[0] >> 5) * kChroma + (ycc[1] >> 2)) * kChroma + (ycc[2] >> 2);
    }
};

// Typical of webcams, which do not report it. An error in it scales all distances alike.
constexpr float kWebcamFov = 1.05f; // horizontal, radians

struct WebcamHand {
    glm::vec3 palm{0}; // metres, camera's frame: x right in the picture, y up, the camera looks along -z
    cv::Point2f palm_px;
    float radius_px = 0; // both of the picture reduced to kWidth
    Gesture gesture = Gesture::Open;
};

class HandDetector {
  public:
    static constexpr int kWidth = 320; // pictures are reduced to this before anything else
    static constexpr double kBackground_s = 0.5;
    static constexpr double kHand_s = 2;

    explicit HandDetector(const HandRig& rig) : rig_(rig) {}

    // The next picture, blue first, of any size. time_s rises.
    HandFrame detect(const cv::Mat& bgr, double time_s);

    bool calibrated() const { return skin_.learnt(); }
    std::string instruction() const; // of the player, while it learns; else empty
    const std::array<std::optional<WebcamHand>, 2>& hands() const { return hands_; } // left, right

  private:
    enum class Learning { Background, Waiting, Hand, Done };
    void learn(double time_s);
    void assign(const std::vector<Outline>& outlines, double time_s);
    HandPose poseOf(const WebcamHand& hand, Side side) const;

    HandRig rig_;
    SkinColour skin_;
    Learning learning_ = Learning::Background;
    double since_s_ = -1;
    cv::Mat small_, ycc_, background_, changed_, likely_, mask_;
    std::array<std::optional<WebcamHand>, 2> hands_;
    std::array<std::optional<WebcamHand>, 2> last_; // as last seen, at lastSeen_s_
    std::array<double, 2> lastSeen_s_{-1e9, -1e9};
    std::array<int64_t, 2> identity_{0, 0};
    struct Vote {
        Gesture proposed = Gesture::Open;
        int count = 0;
    };
    std::array<Vote, 2> votes_;
};

} // namespace shoal::hands
