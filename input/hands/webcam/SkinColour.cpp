#include "input/hands/webcam/SkinColour.h"

#include <opencv2/imgproc.hpp>

namespace shoal::hands {

void SkinColour::addBackground(const cv::Mat& ycc) {
    for (int y = 0; y < ycc.rows; ++y)
        for (int x = 0; x < ycc.cols; ++x) background_.at<float>(bin(ycc.at<cv::Vec3b>(y, x))) += 1;
}

void SkinColour::addHand(const cv::Mat& ycc, const cv::Mat& where) {
    for (int y = 0; y < ycc.rows; ++y)
        for (int x = 0; x < ycc.cols; ++x)
            if (where.at<uchar>(y, x)) hand_.at<float>(bin(ycc.at<cv::Vec3b>(y, x))) += 1;
}

void SkinColour::learn() {
    // Few pixels for many bins: neighbouring colours are alike.
    const auto smoothed = [](const cv::Mat& histogram) {
        cv::Mat chroma(kLight * kChroma, kChroma, CV_32F, histogram.data);
        cv::Mat out(kLight * kChroma, kChroma, CV_32F), light(kLight, kChroma * kChroma, CV_32F, out.data);
        for (int y = 0; y < kLight; ++y) {
            cv::Mat slice = out.rowRange(y * kChroma, (y + 1) * kChroma);
            cv::GaussianBlur(chroma.rowRange(y * kChroma, (y + 1) * kChroma), slice, {}, 1.5);
        }
        const float weights[] = {0.25f, 0.5f, 0.25f};
        cv::filter2D(light, light, -1, cv::Mat(3, 1, CV_32F, const_cast<float*>(weights)));
        return cv::Mat(out / std::max(cv::sum(out)[0], 1.0));
    };
    const cv::Mat hand = smoothed(hand_), background = smoothed(background_);
    // A colour that neither showed is not the hand's.
    const cv::Mat share = hand / (hand + background + 1e-6);
    share.reshape(1, kBins).convertTo(likely_, CV_8U, 255);
}

void SkinColour::likelihood(const cv::Mat& ycc, cv::Mat& out) const {
    out.create(ycc.size(), CV_8U);
    for (int y = 0; y < ycc.rows; ++y)
        for (int x = 0; x < ycc.cols; ++x)
            out.at<uchar>(y, x) = likely_.at<uchar>(bin(ycc.at<cv::Vec3b>(y, x)));
}

} // namespace shoal::hands
