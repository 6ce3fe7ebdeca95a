// Finds both hands in the pictures of a webcam by learned landmarks, and follows them.
#pragma once

#include "input/hands/CompleteHand.h"
#include "input/hands/HandTracker.h"
#include "input/hands/webcam/landmarks/HandNets.h"

#include <opencv2/core.hpp>

#include <optional>
#include <span>
#include <vector>

namespace shoal::hands {

// Horizontal field of view of a typical webcam, which does not report it, radians. An error in it scales all
// distances alike.
constexpr float kWebcamFov = 1.05f;

class LandmarkFinder {
  public:
    // folder: where get_models puts the models.
    static Result<LandmarkFinder> load(const Path& folder, const HandRig& rig) {
        auto nets = HandNets::load(folder);
        if (!nets) return nets.error();
        return LandmarkFinder(std::move(*nets), rig);
    }

    // Finds the hands in the next picture, blue first, of any size; camera's frame. time_s rises.
    HandFrame detect(const cv::Mat& bgr, double time_s);
    // Landmarks of the hands in the last picture, in its pixels, for the preview.
    std::span<const cv::Point2f> marks() const { return marks_; }

  private:
    LandmarkFinder(HandNets nets, const HandRig& rig) : nets_(std::move(nets)), completer_(rig), rig_(rig) {
        tracks_.reserve(2);
    }

    struct Track {
        Landmarks hand;
        int pictures = 0; // number of pictures in a row that show it
        float right = 0.5f;
        Side side = Side::Right;
        int64_t identity = 0;

        bool isSure() const { return pictures >= 2; } // taken for a hand
    };
    void follow(const cv::Mat& bgr);
    void lookForNew(const cv::Mat& bgr);
    void decideSides();
    std::optional<HandPose> poseOf(const Track& track, cv::Size picture) const;

    HandNets nets_;
    HandCompleter completer_;
    HandRig rig_;
    std::vector<Track> tracks_; // two at most, the older first
    std::vector<cv::Point2f> marks_;
    cv::Mat brightened_;
    int64_t identities_ = 0, pictures_ = 0;
};

} // namespace shoal::hands
