#include "input/hands/webcam/landmarks/LandmarkFinder.h"

#include "engine/math/Trigonometry.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::hands {

namespace {

constexpr float kPresent = 0.5f; // least presence with which a hand is followed...
constexpr float kNew = 0.7f;     // ...and with which a new one is accepted
constexpr int kLookEvery = 3; // pictures between searches for a second hand, which cost more than following
constexpr float kSameHand = 0.6f;           // palms nearer than this, in lengths of a palm, are one
constexpr float kSideShare = 0.1f;          // weight of the newest picture in the estimate of a hand's side
constexpr float kNear_m = 0.1f, kFar_m = 3; // range of believable distances

constexpr size_t kWrist = 0, kIndexKnuckle = 5, kMiddleKnuckle = 9, kRingKnuckle = 13, kLittleKnuckle = 17;

// The joint at each landmark; the fingers' metacarpals have none.
constexpr std::array<int, kLandmarkCount> kJointAt = [] {
    std::array<int, kLandmarkCount> joints{kWristJoint};
    for (int finger = 0; finger < kFingerCount; ++finger)
        for (int i = 0; i < 4; ++i) joints[1 + 4 * finger + i] = kFingerJoints[finger].tip - 3 + i;
    return joints;
}();

// Bones of the palm, which do not bend, and so tell a hand's size.
constexpr std::array kPalmBones = {std::pair{kWrist, kIndexKnuckle}, std::pair{kWrist, kMiddleKnuckle},
                                   std::pair{kWrist, kRingKnuckle}, std::pair{kWrist, kLittleKnuckle},
                                   std::pair{kIndexKnuckle, kLittleKnuckle}};

// Distances by which the network's landmarks lie beyond the joints, towards the fingertips, metres: means
// over pictures of the rig's hand, open and pinching. Fingers: from the root to the tip.
constexpr float kWristBeyond_m = 0.0025f;
constexpr std::array<float, 4> kThumbBeyond_m = {0.008f, 0.003f, 0.001f, -0.0025f},
                               kFingerBeyond_m = {0.003f, -0.001f, -0.002f, -0.0035f};

glm::vec3 landmarkOf(const HandPose& hand, size_t landmark) {
    const Joint& joint = hand.joints[kJointAt[landmark]];
    float beyond = kWristBeyond_m;
    if (landmark != kWrist) {
        const auto& finger = landmark < kIndexKnuckle ? kThumbBeyond_m : kFingerBeyond_m;
        beyond = finger[(landmark - 1) % 4];
    }
    return joint.position + joint.orientation * glm::vec3(0, 0, -beyond);
}

cv::Point2f palmOf(const Landmarks& hand) {
    return 0.2f * (hand.at[kWrist] + hand.at[kIndexKnuckle] + hand.at[kMiddleKnuckle] +
                   hand.at[kRingKnuckle] + hand.at[kLittleKnuckle]);
}

float palmLength(const Landmarks& hand) {
    return static_cast<float>(cv::norm(hand.at[kMiddleKnuckle] - hand.at[kWrist]));
}

bool same(const Landmarks& a, const Landmarks& b) {
    return cv::norm(palmOf(a) - palmOf(b)) <
           static_cast<double>(kSameHand * std::max(palmLength(a), palmLength(b)));
}

// Returns the axes of a palm: across to the index finger's side, ahead to the fingers, and their product.
glm::mat3 palmAxes(const std::array<glm::vec3, kLandmarkCount>& at) {
    const glm::vec3 ahead = glm::normalize(at[kMiddleKnuckle] - at[kWrist]);
    const glm::vec3 across = at[kIndexKnuckle] - at[kLittleKnuckle];
    const glm::vec3 side = glm::normalize(across - ahead * glm::dot(across, ahead));
    return {side, ahead, glm::cross(side, ahead)};
}

// Returns the factor that makes a dark picture bright enough to find hands in; else 1.
double gainFor(const cv::Mat& bgr) {
    constexpr double kDark = 70, kBright = 110, kMaxGain = 6; // means of a picture, of 255
    const cv::Scalar mean = cv::mean(bgr);
    const double light = (mean[0] + mean[1] + mean[2]) / 3;
    return light < kDark ? std::min(kBright / std::max(light, 1.0), kMaxGain) : 1.0;
}

// A hand in the camera's frame: x right, y up, z towards the camera.
struct Seen {
    std::array<glm::vec3, kLandmarkCount> ray;   // z is -1
    std::array<glm::vec3, kLandmarkCount> shape; // metres, in the size of the rig's hand
};
struct Fit {
    glm::quat turn;
    glm::vec3 wrist;
    HandShape hand;
};
constexpr int kResiduals = 3 * kLandmarkCount + 1 + kFingerCount, kUnknowns = 12;
using Residuals = cv::Vec<float, kResiduals>;
using Step = cv::Vec<float, kUnknowns>; // radians, metres, five curls, spread

// The landmarks are exact within a few pixels across the picture, but not in depth: the network bends the
// fingers of an open hand by 40 mm at their tips. So the rig's hand is fitted to them, by Levenberg and
// Marquardt's method from the network's shape; depth decides only where the picture is ambiguous.
Fit firstFit(const Seen& seen, const std::array<glm::vec3, kLandmarkCount>& rest) {
    // Least squares for the place p of the shape: (p + shape).xy = ray.xy (p + shape).z / ray.z at every
    // landmark.
    glm::mat3 normal(0);
    glm::vec3 right(0);
    for (size_t i = 0; i < kLandmarkCount; ++i)
        for (int axis = 0; axis < 2; ++axis) {
            glm::vec3 row(0, 0, seen.ray[i][axis]); // ray.z is -1
            row[axis] = 1;
            normal += glm::outerProduct(row, row);
            right -= row * (seen.ray[i][axis] * seen.shape[i].z + seen.shape[i][axis]);
        }
    Fit fit{.turn = glm::normalize(glm::quat_cast(palmAxes(seen.shape) * glm::transpose(palmAxes(rest)))),
            .wrist = glm::inverse(normal) * right + seen.shape[kWrist]};
    for (int finger = 0; finger < kFingerCount; ++finger) {
        const auto root = static_cast<size_t>(1 + 4 * finger);
        float bend = 0;
        for (size_t i = root; i < root + 3; ++i) {
            const glm::vec3 before = seen.shape[i] - seen.shape[i == root ? kWrist : i - 1],
                            after = seen.shape[i + 1] - seen.shape[i];
            bend += math::arcCosine(glm::dot(before, after) /
                                    std::max(glm::length(before) * glm::length(after), 1e-9f));
        }
        fit.hand.curl[finger] =
            std::clamp(bend / (finger == 0 ? 2.0f : 4.1f), 0.0f, 1.0f); // bends of the rig's fist, radians
    }
    return fit;
}

Residuals residuals(const HandRig& rig, const Fit& fit, const Seen& seen, Side side) {
    // Standard deviations. The wrist's is larger: nothing marks it on an arm, and a sleeve hides it.
    constexpr float kAcross_m = 0.003f, kWristAcross_m = 0.01f, kDepth_m = 0.3f, kSpread = 2, kCurl = 0.3f;
    const HandPose pose = rig.pose(side, fit.hand, {fit.wrist, fit.turn});
    Residuals out;
    for (size_t i = 0; i < kLandmarkCount; ++i) {
        const glm::vec3 p = landmarkOf(pose, i);
        const float across_m = i == kWrist ? kWristAcross_m : kAcross_m;
        out.val[3 * i] = (p.x + seen.ray[i].x * p.z) / across_m;
        out.val[3 * i + 1] = (p.y + seen.ray[i].y * p.z) / across_m;
        out.val[3 * i + 2] = (p.z - fit.wrist.z - seen.shape[i].z + seen.shape[kWrist].z) / kDepth_m;
    }
    out(3 * kLandmarkCount) = fit.hand.spread / kSpread;
    for (int finger = 0; finger < kFingerCount; ++finger)
        out(3 * kLandmarkCount + 1 + finger) = fit.hand.curl[finger] / kCurl;
    return out;
}

Fit moved(Fit fit, const Step& by) {
    fit.turn = glm::normalize(glm::quat(1, by(0) / 2, by(1) / 2, by(2) / 2) * fit.turn);
    fit.wrist += glm::vec3(by(3), by(4), by(5));
    for (int finger = 0; finger < kFingerCount; ++finger) {
        float& curl = fit.hand.curl[finger];
        curl = std::clamp(curl + by(6 + finger), 0.0f, 1.0f);
    }
    fit.hand.spread = std::clamp(fit.hand.spread + by(11), -1.0f, 1.0f);
    return fit;
}

HandPose fitted(const HandRig& rig, const Seen& seen, Side side) {
    const HandPose rest = rig.pose(side, {}, {});
    std::array<glm::vec3, kLandmarkCount> restAt;
    for (size_t i = 0; i < kLandmarkCount; ++i) restAt[i] = rest.joints[kJointAt[i]].position;
    Fit fit = firstFit(seen, restAt);
    Residuals off = residuals(rig, fit, seen, side);
    float damping = 1e-3f;
    for (int round = 0; round < 10; ++round) {
        constexpr float kDelta = 1e-3f; // radians, metres, shares
        cv::Matx<float, kResiduals, kUnknowns> slope;
        for (int k = 0; k < kUnknowns; ++k) {
            Step delta;
            delta(k) = kDelta;
            // Steps away from the end of a range, beyond which nothing changes.
            if (k >= 6 && k < 11 && fit.hand.curl[k - 6] > 0.5f) delta(k) = -kDelta;
            if (k == 11 && fit.hand.spread > 0) delta(k) = -kDelta;
            const Residuals changed = (residuals(rig, moved(fit, delta), seen, side) - off) * (1 / delta(k));
            for (int i = 0; i < kResiduals; ++i) slope(i, k) = changed(i);
        }
        auto normal = slope.t() * slope;
        for (int k = 0; k < kUnknowns; ++k) normal(k, k) *= 1 + damping;
        const Step step = normal.solve(slope.t() * off, cv::DECOMP_CHOLESKY) * -1.0f;
        const Fit next = moved(fit, step);
        const Residuals nextOff = residuals(rig, next, seen, side);
        const bool better = nextOff.dot(nextOff) < off.dot(off);
        damping *= better ? 0.3f : 10.0f;
        if (!better) continue;
        fit = next;
        off = nextOff;
    }
    return rig.pose(side, fit.hand, {fit.wrist, fit.turn});
}

} // namespace

void LandmarkFinder::follow(const cv::Mat& bgr) {
    for (Track& track : tracks_) {
        track.hand = nets_.findLandmarks(bgr, cropAround(track.hand));
        ++track.pictures;
    }
    std::erase_if(tracks_, [](const Track& track) {
        return !(track.hand.presence >= (track.isSure() ? kPresent : kNew));
    });
    // Both tracks may end up on the hand in front when hands cross.
    if (tracks_.size() == 2 && same(tracks_[0].hand, tracks_[1].hand)) tracks_.pop_back();
}

void LandmarkFinder::lookForNew(const cv::Mat& bgr) {
    for (const FoundPalm& palm : nets_.findPalms(bgr)) {
        if (tracks_.size() == 2) return;
        const Landmarks hand = nets_.findLandmarks(bgr, palm.hand);
        const auto isFollowedBy = [&](const Track& track) { return same(track.hand, hand); };
        if (hand.presence >= kNew && std::ranges::none_of(tracks_, isFollowedBy))
            tracks_.push_back({.hand = hand, .pictures = 1, .right = hand.right, .identity = ++identities_});
    }
}

// Decides the hands' sides: two hands are always a right and a left one, whichever pairing is likelier.
void LandmarkFinder::decideSides() {
    for (Track& track : tracks_) track.right = std::lerp(track.right, track.hand.right, kSideShare);
    if (tracks_.empty()) return;
    bool right = tracks_[0].right > (tracks_.size() == 2 ? tracks_[1].right : 0.5f);
    for (Track& track : tracks_) {
        const Side side = right ? Side::Right : Side::Left;
        if (side != track.side && track.isSure()) track.identity = ++identities_;
        track.side = side;
        right = !right;
    }
}

std::optional<HandPose> LandmarkFinder::poseOf(const Track& track, cv::Size picture) const {
    const Landmarks& hand = track.hand;
    const cv::Point2f middle(0.5f * static_cast<float>(picture.width),
                             0.5f * static_cast<float>(picture.height));
    const float focal_px = middle.x / std::tan(kWebcamFov / 2);
    const auto rayTo = [&](const cv::Point2f& p) {
        return glm::vec3((p.x + 0.5f - middle.x) / focal_px, (middle.y - p.y - 0.5f) / focal_px, -1);
    };
    const HandPose rest = rig_.pose(Side::Right, {}, {});
    float bones = 0, bonesOfRig_m = 0;
    for (const auto& [a, b] : kPalmBones) {
        bones += glm::distance(hand.shape[a], hand.shape[b]);
        bonesOfRig_m += glm::distance(landmarkOf(rest, a), landmarkOf(rest, b));
    }
    const float scale = bonesOfRig_m / std::max(bones, 1e-3f);
    // The network sees a crop as if its middle were straight ahead.
    const glm::quat turn(glm::vec3(0, 0, -1), glm::normalize(rayTo(palmOf(hand))));
    Seen seen;
    for (size_t i = 0; i < kLandmarkCount; ++i) {
        seen.ray[i] = rayTo(hand.at[i]);
        seen.shape[i] = turn * (hand.shape[i] * glm::vec3(scale, -scale, -scale));
    }
    const HandPose fit = fitted(rig_, seen, track.side);
    PartialHand partial;
    for (size_t i = 0; i < kLandmarkCount; ++i) {
        const auto joint = static_cast<size_t>(kJointAt[i]);
        const float depth = -landmarkOf(fit, i).z;
        if (!(depth > kNear_m && depth < kFar_m)) return std::nullopt;
        partial.joints[joint] = seen.ray[i] * depth + fit.joints[joint].position - landmarkOf(fit, i);
    }
    partial.palm = fit.joints[kPalmJoint].position;
    partial.direction = fit.joints[kPalmJoint].orientation * glm::vec3(0, 0, -1);
    partial.normal = fit.joints[kPalmJoint].orientation * glm::vec3(0, -1, 0);
    partial.confidence = hand.presence;
    const HandPose pose = completer_.complete(partial, track.side);
    return plausible(pose) ? std::optional(pose) : std::nullopt;
}

HandFrame LandmarkFinder::detect(const cv::Mat& given, double time_s) {
    HandFrame frame;
    frame.time_us = static_cast<int64_t>(time_s * 1e6);
    marks_.clear();
    if (given.empty() || given.type() != CV_8UC3) return frame;
    const double gain = gainFor(given);
    if (gain > 1) given.convertTo(brightened_, -1, gain);
    const cv::Mat& bgr = gain > 1 ? brightened_ : given;
    follow(bgr);
    if (tracks_.empty() || (tracks_.size() == 1 && ++pictures_ % kLookEvery == 0)) lookForNew(bgr);
    decideSides();
    for (const Track& track : tracks_) {
        if (!track.isSure()) continue;
        marks_.insert(marks_.end(), track.hand.at.begin(), track.hand.at.end());
        const auto pose = poseOf(track, bgr.size());
        if (!pose) continue;
        const size_t side = track.side == Side::Left ? 0 : 1;
        frame.hands[side] = *pose;
        frame.hands[side].time_us = frame.time_us;
        frame.identity[side] = track.identity;
    }
    return frame;
}

} // namespace shoal::hands
