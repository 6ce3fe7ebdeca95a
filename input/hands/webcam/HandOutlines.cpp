#include "input/hands/webcam/HandDetector.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::hands {

namespace {

// In radii of the palm but where another unit stands.
constexpr double kMinArea = 0.006;   // of the picture
constexpr float kFingerReach = 3.6f; // what is farther from the palm is an arm, not a finger
constexpr float kCleftDepth = 0.6f;
constexpr float kCleftAngle = 1.5f; // radians between two fingers that stand; wider is a wrist
constexpr float kStands = 1.75f;    // a fingertip is farther from the palm's middle than this
constexpr double kMinHole = 0.04;   // of the palm circle's area
constexpr float kTogether = 2.3f;   // no finger of a fist stands higher above the palm's middle

float distance(const cv::Point2f& a, const cv::Point2f& b) { return std::hypot(a.x - b.x, a.y - b.y); }

struct Cleft {
    cv::Point2f deep; // where it ends, from the palm's middle, in radii
    float angle = 0;  // between the fingers beside it
};

std::vector<Cleft> findClefts(const std::vector<cv::Point>& outline, const cv::Point2f& palm, float radius) {
    std::vector<int> hull;
    cv::convexHull(outline, hull);
    std::sort(hull.begin(), hull.end()); // an outline that touches itself would else be refused
    if (hull.size() < 4 || outline.size() < 8) return {};
    std::vector<cv::Vec4i> defects;
    cv::convexityDefects(outline, hull, defects);
    std::vector<Cleft> clefts;
    for (const cv::Vec4i& defect : defects) {
        const cv::Point2f a = outline[static_cast<size_t>(defect[0])],
                          b = outline[static_cast<size_t>(defect[1])],
                          deep = outline[static_cast<size_t>(defect[2])];
        if (static_cast<float>(defect[3]) / 256 < kCleftDepth * radius) continue;
        if (distance(a, palm) < kStands * radius || distance(b, palm) < kStands * radius) continue;
        const cv::Point2f u = a - deep, v = b - deep;
        const float cosine = u.dot(v) / std::max(distance(a, deep) * distance(b, deep), 1.0f);
        const float angle = std::acos(std::clamp(cosine, -1.0f, 1.0f));
        if (angle < kCleftAngle) clefts.push_back({(deep - palm) / radius, angle});
    }
    return clefts;
}

// The widest cleft of an open hand is the one beside the thumb. Which side of the others is it?
int thumbOf(const std::vector<Cleft>& clefts) {
    if (clefts.size() != 4) return 0;
    const auto widest = std::max_element(clefts.begin(), clefts.end(),
                                         [](const Cleft& a, const Cleft& b) { return a.angle < b.angle; });
    cv::Point2f up(0, 0);
    for (const Cleft& cleft : clefts)
        if (&cleft != &*widest) up += cleft.deep;
    const float turn = up.x * widest->deep.y - up.y * widest->deep.x; // y runs down
    return turn > 0 ? 1 : -1;
}

Gesture gestureOf(const Outline& hand) {
    if (hand.clefts >= 3) return Gesture::Open;
    if (hand.ring || hand.clefts >= 1) return Gesture::Pinch; // three fingers stand, thumb and index do not
    return hand.highest > kTogether ? Gesture::Open : Gesture::Fist; // fingers held together
}

} // namespace

std::vector<Outline> findHands(const cv::Mat& mask) {
    cv::Mat whole = mask.clone();
    std::vector<std::vector<cv::Point>> outlines;
    std::vector<cv::Vec4i> family; // next, previous, first hole, parent
    cv::findContours(whole, outlines, family, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
    std::vector<std::pair<double, size_t>> bySize;
    for (size_t i = 0; i < outlines.size(); ++i) {
        const double area = cv::contourArea(outlines[i]);
        if (family[i][3] < 0 && area > kMinArea * static_cast<double>(mask.total()))
            bySize.emplace_back(area, i);
    }
    std::sort(bySize.rbegin(), bySize.rend());
    if (bySize.size() > 2) bySize.resize(2);

    std::vector<Outline> hands;
    for (const auto& [area, index] : bySize) {
        // Holes are filled for the palm: a gap in the colour is not a gap in the hand.
        cv::Mat filled = cv::Mat::zeros(mask.rows + 2, mask.cols + 2, CV_8U), depth;
        cv::drawContours(filled, outlines, static_cast<int>(index), 255, cv::FILLED, cv::LINE_8,
                         cv::noArray(), 0, {1, 1});
        cv::distanceTransform(filled, depth, cv::DIST_L2, 5);
        double radius = 0;
        cv::Point middle;
        cv::minMaxLoc(depth, nullptr, &radius, nullptr, &middle);
        Outline hand;
        hand.radius = static_cast<float>(radius);
        // The ridge's middle rather than its highest pixel, which jumps about.
        const cv::Moments ridge = cv::moments(depth > 0.93 * radius, true);
        hand.palm = ridge.m00 > 0
                        ? cv::Point2f(static_cast<float>(ridge.m10 / ridge.m00) - 1,
                                      static_cast<float>(ridge.m01 / ridge.m00) - 1)
                        : cv::Point2f(static_cast<float>(middle.x - 1), static_cast<float>(middle.y - 1));
        if (distance(hand.palm, middle) > hand.radius) hand.palm = middle; // two ridges
        cv::Mat near = cv::Mat::zeros(filled.size(), CV_8U);
        cv::circle(near, cv::Point(cvRound(hand.palm.x) + 1, cvRound(hand.palm.y) + 1),
                   cvRound(kFingerReach * hand.radius), 255, cv::FILLED);
        near &= filled;
        std::vector<std::vector<cv::Point>> parts;
        cv::findContours(near, parts, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, {-1, -1});
        const auto largest = std::max_element(
            parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
        if (largest == parts.end()) continue;
        for (const cv::Point& p : *largest) {
            const cv::Point2f from = (cv::Point2f(p) - hand.palm) / hand.radius;
            if (std::fabs(from.x) < -from.y) hand.highest = std::max(hand.highest, -from.y);
        }
        const auto clefts = findClefts(*largest, hand.palm, hand.radius);
        hand.clefts = static_cast<int>(clefts.size());
        hand.thumb = thumbOf(clefts);
        for (int hole = family[index][2]; hole >= 0; hole = family[static_cast<size_t>(hole)][0])
            hand.ring |=
                cv::contourArea(outlines[static_cast<size_t>(hole)]) > kMinHole * CV_PI * radius * radius;
        hand.gesture = gestureOf(hand);
        hands.push_back(hand);
    }
    return hands;
}

} // namespace shoal::hands
