#include "input/hands/webcam/HandDetector.h"

#include "input/hands/HandTracker.h"
#include "input/hands/MouseHands.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::hands {

namespace {

constexpr int kChangedBy = 14;       // of 255, in any channel: no longer the background
constexpr int kLikely = 110;         // of 255: the hand's colour
constexpr float kDiscRadius = 0.10f; // of the picture's height: where the hand is held to be learnt
constexpr double kDiscFilled = 0.6;
constexpr int kVotes = 2;          // pictures in a row that change a gesture
constexpr double kForget_s = 0.5;  // a hand not seen for so long may come back as the other one
constexpr double kSizeTau_s = 0.1; // the palm's size is smoothed: distance is its reciprocal

// Radius of the largest circle inside a hand's outline, metres, for each Gesture; of the rig's hand.
constexpr std::array kPalmRadius_m = {0.0441f, 0.0446f, 0.0437f};

// Of the histograms of colour.
constexpr int kChannels[] = {0, 1, 2};
constexpr float kRange[] = {0, 256};

// Thumb and index touch, the others stand.
constexpr HandShape kPinchShape{{0.85f, 0.68f, 0.15f, 0.13f, 0.13f}, 0.3f};

} // namespace

void SkinColour::add(cv::Mat& histogram, const cv::Mat& ycc, const cv::Mat& where) {
    const float* ranges[] = {kRange, kRange, kRange};
    cv::calcHist(&ycc, 1, kChannels, where, histogram, 3, kBins, ranges, true, true);
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
    likely_ = share.reshape(1, 3, kBins);
}

void SkinColour::likelihood(const cv::Mat& ycc, cv::Mat& out) const {
    const float* ranges[] = {kRange, kRange, kRange};
    cv::calcBackProject(&ycc, 1, kChannels, likely_, out, ranges, 255);
}

Instruction HandDetector::instruction() const {
    switch (learning_) {
    case Learning::Background:
        return Instruction::KeepHandsAway;
    case Learning::Waiting:
        return Instruction::ShowOpenHand;
    case Learning::Hand:
        return Instruction::KeepHandThere;
    case Learning::Done:
        break;
    }
    return Instruction::None;
}

void HandDetector::learn(double time_s) {
    if (since_s_ < 0) since_s_ = time_s;
    if (learning_ == Learning::Background) {
        skin_.addBackground(ycc_);
        cv::Mat now;
        ycc_.convertTo(now, CV_32F);
        if (background_.empty())
            background_ = now;
        else
            cv::accumulateWeighted(now, background_, 0.2);
        if (time_s - since_s_ < kBackground_s) return;
        background_.convertTo(background_, CV_8U);
        learning_ = Learning::Waiting;
        return;
    }
    cv::Mat disc = cv::Mat::zeros(ycc_.size(), CV_8U);
    cv::circle(disc, {ycc_.cols / 2, ycc_.rows / 2}, cvRound(kDiscRadius * static_cast<float>(ycc_.rows)),
               255, cv::FILLED);
    const int size = cv::countNonZero(disc);
    disc &= changed_;
    const bool there = cv::countNonZero(disc) > kDiscFilled * size;
    if (!there) { // taken away too soon: from the beginning
        learning_ = Learning::Waiting;
        return;
    }
    if (learning_ == Learning::Waiting) {
        learning_ = Learning::Hand;
        since_s_ = time_s;
    }
    skin_.addHand(ycc_, disc);
    if (time_s - since_s_ < kHand_s) return;
    skin_.learn();
    learning_ = Learning::Done;
}

// The camera looks back: what is on the right of its picture is on the player's left. A hand stays what it
// was.
void HandDetector::assign(const std::vector<Outline>& outlines, double time_s) {
    const float focal_px = static_cast<float>(small_.cols) / 2 / std::tan(kWebcamFov / 2);
    const auto known = [&](size_t side) { return time_s - tracked_[side].seen_s < kForget_s; };
    std::array<size_t, 2> sides{};
    if (outlines.size() == 2) {
        sides[0] = outlines[0].palm.x > outlines[1].palm.x ? 0 : 1;
        sides[1] = 1 - sides[0];
    } else if (outlines.size() == 1) {
        const auto apart = [&](size_t side) {
            return known(side) ? cv::norm(tracked_[side].last.palm_px - outlines[0].palm) : 1e6;
        };
        if (apart(0) != apart(1))
            sides[0] = apart(0) < apart(1) ? 0 : 1;
        else if (outlines[0].thumb != 0) // of a palm to the camera
            sides[0] = outlines[0].thumb > 0 ? 1 : 0;
        else
            sides[0] = outlines[0].palm.x * 2 > static_cast<float>(small_.cols) ? 0 : 1;
    }
    for (size_t i = 0; i < outlines.size(); ++i) {
        const Outline& outline = outlines[i];
        Tracked& tracked = tracked_[sides[i]];
        WebcamHand hand{.palm_px = outline.palm, .radius_px = outline.radius, .gesture = outline.gesture};
        if (known(sides[i])) {
            const double share = 1 - std::exp((tracked.seen_s - time_s) / kSizeTau_s);
            hand.radius_px = std::lerp(tracked.last.radius_px, outline.radius, static_cast<float>(share));
            tracked.votes = outline.gesture == tracked.proposed ? tracked.votes + 1 : 1;
            if (tracked.votes < kVotes) hand.gesture = tracked.last.gesture;
        } else {
            tracked.votes = kVotes;
            ++tracked.identity;
        }
        tracked.proposed = outline.gesture;
        const float z =
            focal_px * kPalmRadius_m[static_cast<size_t>(hand.gesture)] / std::max(hand.radius_px, 1.0f);
        hand.palm = {(outline.palm.x + 0.5f - static_cast<float>(small_.cols) / 2) * z / focal_px,
                     (static_cast<float>(small_.rows) / 2 - outline.palm.y - 0.5f) * z / focal_px, -z};
        hands_[sides[i]] = tracked.last = hand;
        tracked.seen_s = time_s;
    }
}

// Only the palm's place and the gesture are seen; the rest is how a viewer's hand reaches there.
HandPose HandDetector::poseOf(const WebcamHand& hand, Side side) const {
    const glm::vec3 palm = kCameraMount.place(hand.palm);
    HandPose pose = reachingHand(rig_, side, palm, hand.gesture == Gesture::Fist ? 1.0f : 0.0f);
    if (hand.gesture == Gesture::Pinch)
        pose = rig_.pose(side, kPinchShape, {pose.joints[1].position, pose.joints[1].orientation});
    const glm::vec3 by = palm - pose.joints[0].position;
    for (Joint& joint : pose.joints) joint.position += by;
    pose.confidence = 0.6f;
    pose.grip = hand.gesture == Gesture::Fist ? 1.0f : 0.0f;
    pose.pinch = hand.gesture == Gesture::Pinch ? 1.0f : 0.0f;
    kCameraMount.undo(pose);
    return pose;
}

HandFrame HandDetector::detect(const cv::Mat& bgr, double time_s) {
    HandFrame frame;
    frame.time_us = static_cast<int64_t>(time_s * 1e6);
    hands_ = {};
    // Of all shapes that a camera has; others would grow, not shrink.
    if (bgr.empty() || bgr.type() != CV_8UC3 || bgr.rows > 3 * bgr.cols) return frame;
    cv::resize(bgr, small_, {kWidth, std::max(1, kWidth * bgr.rows / bgr.cols)}, 0, 0, cv::INTER_AREA);
    // Always the same as while it learnt: what is there is told by how it differs from the background.
    if (gain_ == 0) gain_ = gainFor(small_);
    small_.convertTo(small_, -1, gain_);
    cv::cvtColor(small_, ycc_, cv::COLOR_BGR2YCrCb);
    cv::GaussianBlur(ycc_, ycc_, {}, 0.8);
    if (!background_.empty() && background_.size() != ycc_.size()) { // another picture altogether: learn anew
        *this = HandDetector(rig_);
        return frame;
    }
    if (learning_ != Learning::Background) {
        cv::Mat apart, channels[3];
        cv::absdiff(ycc_, background_, apart);
        cv::split(apart, channels);
        changed_ = cv::max(channels[0], cv::max(channels[1], channels[2])) > kChangedBy;
    }
    if (learning_ != Learning::Done) {
        learn(time_s);
        return frame;
    }
    skin_.likelihood(ycc_, likely_);
    cv::GaussianBlur(likely_, likely_, {}, 1);
    mask_ = (likely_ > kLikely) & changed_;
    // Gaps within the hand are closed; what is thinner than half a finger is not of it.
    cv::morphologyEx(mask_, mask_, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
    cv::morphologyEx(mask_, mask_, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
    assign(findHands(mask_), time_s);
    for (size_t side = 0; side < 2; ++side) {
        if (!hands_[side]) continue;
        frame.hands[side] = poseOf(*hands_[side], side == 0 ? Side::Left : Side::Right);
        frame.hands[side].time_us = frame.time_us;
        frame.identity[side] = tracked_[side].identity;
    }
    return frame;
}

} // namespace shoal::hands
