// Colour model of a player's hands, calibrated on a few pictures, for segmentation from the background.
#pragma once

#include <opencv2/core.hpp>

namespace shoal::hands {

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

} // namespace shoal::hands
