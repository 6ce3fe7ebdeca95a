// Detection of hands in the pictures of a webcam: segmentation by a colour that is calibrated on the player,
// and the geometry of outlines. No learned weights: for players who have not fetched the models.
#pragma once

#include "input/hands/HandFilter.h"
#include "input/hands/HandRig.h"
#include "input/hands/webcam/HandFinder.h"

#include <opencv2/core.hpp>

#include <optional>
#include <vector>

namespace shoal::hands {

// Palm, fingers and gesture of a hand outline in a segmentation mask.
struct Outline {
    cv::Point2f palm;  // pixels; the middle of the largest circle inside the outline
    float radius = 0;  // of that circle, pixels
    int clefts = 0;    // deep narrow gaps between fingers that stand
    bool ring = false; // thumb and index enclose a hole
    int thumb = 0; // of an open hand, fingers up: 1 on the right of the picture, -1 on the left; 0 unknown
    float highest = 0; // of the outline above the palm's middle, in radii
    Gesture gesture = Gesture::Open;
};

// mask: 8-bit, 255 where a hand may be. The largest outlines first, two at most.
std::vector<Outline> findHands(const cv::Mat& mask);

// Colour model of a player's hands, calibrated on a few pictures, for segmentation from the background.

// Histograms over chroma (Cr and Cb in 64 steps each) and, coarsely, lightness (Y in 8). What counts is how
// much commoner a colour is among the hand's pixels than among the background's: Jones and Rehg 1999,
// "Statistical Color Models with Application to Skin Detection", equation 3, with equal costs.
class SkinColour {
  public:
    // 8-bit YCrCb. where: 8-bit mask.
    void addBackground(const cv::Mat& ycc) { add(background_, ycc, cv::Mat()); }
    void addHand(const cv::Mat& ycc, const cv::Mat& where) { add(hand_, ycc, where); }
    void learn();
    bool learnt() const { return !likely_.empty(); }

    // 0 to 255 for each pixel; learn() comes before.
    void likelihood(const cv::Mat& ycc, cv::Mat& out) const;

  private:
    static void add(cv::Mat& histogram, const cv::Mat& ycc, const cv::Mat& where);

    static constexpr int kChroma = 64, kLight = 8;
    static constexpr int kBins[] = {kLight, kChroma, kChroma};
    cv::Mat hand_ = cv::Mat(3, kBins, CV_32F, cv::Scalar(0)), background_ = hand_.clone();
    cv::Mat likely_; // 0 to 1, by bin
};

struct WebcamHand {
    glm::vec3 palm{0}; // metres, camera's frame: x right in the picture, y up, the camera looks along -z
    cv::Point2f palm_px;
    float radius_px = 0; // both of the picture reduced to kWidth
    Gesture gesture = Gesture::Open;
};

class HandDetector final : public HandFinder {
  public:
    static constexpr int kWidth = 320; // pictures are reduced to this before anything else
    static constexpr double kBackground_s = 0.5;
    static constexpr double kHand_s = 2;

    explicit HandDetector(const HandRig& rig) : rig_(rig) {}

    HandFrame detect(const cv::Mat& bgr, double time_s) override;

    Instruction instruction() const override;                                        // while it learns
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
    double gain_ = 0; // of pictures; 0: none has been seen
    cv::Mat small_, ycc_, background_, changed_, likely_, mask_;
    std::array<std::optional<WebcamHand>, 2> hands_;
    struct Tracked {
        WebcamHand last; // as last seen
        double seen_s = -1e9;
        int64_t identity = 0;
        Gesture proposed = Gesture::Open;
        int votes = 0; // pictures in a row that propose it
    };
    std::array<Tracked, 2> tracked_; // left, right
};

} // namespace shoal::hands
