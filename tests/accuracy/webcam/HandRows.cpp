#include "HandRows.h"

#include "engine/math/Quantile.h"
#include "input/hands/HandTracker.h"

#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace shoal::hands::test {

namespace {

constexpr double kPicture_s = 1 / 30.0;
constexpr int kSettling = 10; // pictures, until hands are followed

const float kFocal_px = kRowWidth / 2.0f / std::tan(kWebcamFov / 2);

// A head with hair, eyes and mouth, a neck, and a shirt of nearly the same colour, 0.6 m away. aside: of the
// picture's middle, pixels.
void drawPerson(cv::Mat& picture, int aside) {
    const cv::Scalar skin(132, 162, 205), darker(105, 130, 178), shirt(120, 150, 190), hair(35, 45, 60);
    const cv::Point middle(picture.cols / 2 + aside, picture.rows * 2 / 5);
    const int r = picture.rows / 6;
    cv::ellipse(picture, middle + cv::Point(0, 4 * r), {3 * r, 2 * r + r / 3}, 0, 0, 360, shirt, cv::FILLED,
                cv::LINE_AA);
    cv::rectangle(picture, middle + cv::Point(-r / 2, r / 2), middle + cv::Point(r / 2, 2 * r), darker,
                  cv::FILLED);
    cv::ellipse(picture, middle - cv::Point(0, r / 5), {r + r / 12, r + r / 2}, 0, 180, 360, hair, cv::FILLED,
                cv::LINE_AA);
    cv::ellipse(picture, middle, {r, r + r / 3}, 0, 0, 360, skin, cv::FILLED, cv::LINE_AA);
    for (const int side : {-1, 1}) {
        const cv::Point eye = middle + cv::Point(side * r * 2 / 5, -r / 5);
        cv::ellipse(picture, eye, {r / 5, r / 9}, 0, 0, 360, {235, 235, 235}, cv::FILLED, cv::LINE_AA);
        cv::circle(picture, eye, r / 10, {50, 40, 30}, cv::FILLED, cv::LINE_AA);
        cv::ellipse(picture, eye - cv::Point(0, r / 5), {r / 4, r / 12}, 0, 180, 360, hair, 3, cv::LINE_AA);
        cv::ellipse(picture, middle + cv::Point(side * r, 0), {r / 6, r / 3}, 0, 0, 360, darker, cv::FILLED,
                    cv::LINE_AA);
    }
    cv::ellipse(picture, middle + cv::Point(0, r / 4), {r / 7, r / 4}, 0, 0, 180, darker, 3, cv::LINE_AA);
    cv::ellipse(picture, middle + cv::Point(0, r * 7 / 10), {r / 3, r / 7}, 0, 0, 180, {90, 90, 170},
                cv::FILLED, cv::LINE_AA);
    cv::GaussianBlur(picture, picture, {}, 1.2);
}

void drawWindow(cv::Mat& picture) {
    picture.setTo(cv::Scalar(96, 98, 100));
    cv::rectangle(picture, {picture.cols / 8, 0}, {picture.cols * 7 / 8, picture.rows * 3 / 4},
                  cv::Scalar(255, 252, 248), cv::FILLED);
    cv::rectangle(picture, {picture.cols / 2 - 6, 0}, {picture.cols / 2 + 6, picture.rows * 3 / 4},
                  cv::Scalar(70, 72, 75), cv::FILLED);
}

void drawSkinWall(cv::Mat& picture) {
    for (int y = 0; y < picture.rows; ++y)
        picture.row(y).setTo(cv::Scalar(132, 162, 205) * (1.05 - 0.2 * y / picture.rows));
}

// Draws a striped sleeve of two colours over the hand's lower half.
void drawSleeve(cv::Mat& picture, const HandPose& hand) {
    const auto at = [&](int joint) {
        const glm::vec3 p = hand.joints[joint].position;
        return cv::Point2f(static_cast<float>(picture.cols) / 2 - p.x / p.z * kFocal_px,
                           static_cast<float>(picture.rows) / 2 + p.y / p.z * kFocal_px);
    };
    const cv::Point2f wrist = at(kWristJoint), ahead = at(kFingerJoints[2].proximal) - wrist;
    const int thick = std::max(1, cvRound(0.95 * cv::norm(ahead)));
    constexpr int kStripes = 14;
    for (int i = 0; i < kStripes; ++i) { // from the elbow on
        const float from = std::lerp(-2.2f, 0.45f, static_cast<float>(i) / kStripes);
        const cv::Point2f a = wrist + from * ahead, b = wrist + (from + 2.65f / kStripes) * ahead;
        const cv::Point2f across = cv::Point2f(-ahead.y, ahead.x) *
                                   (0.5f * static_cast<float>(thick) / static_cast<float>(cv::norm(ahead)));
        const std::array<cv::Point, 4> stripe = {a - across, a + across, b + across, b - across};
        cv::fillConvexPoly(picture, stripe.data(), 4,
                           i % 2 ? cv::Scalar(60, 60, 190) : cv::Scalar(225, 225, 220), cv::LINE_AA);
    }
}

// Returns the motion of a hand: gestures change every half second, hands sway and turn.
Shown shownAt(const Row& row, Side side, int number) {
    const float t = static_cast<float>(number) / 30, sign = side == Side::Left ? 1.0f : -1.0f;
    Shown shown;
    shown.gesture = static_cast<Gesture>((number / 15 + (side == Side::Left ? 1 : 0)) % 3);
    const float apart =
        row.left && row.right ? 0.24f : 0.1f; // of the distance: the width of a picture is 1.16
    shown.palm = {row.distance_m * (sign * apart + 0.06f * std::sin(1.7f * t)),
                  row.distance_m * 0.05f * std::sin(2.3f * t),
                  -row.distance_m * (1 + 0.08f * std::sin(1.3f * t))};
    if (row.trouble == Trouble::Crossing) { // there and back within five seconds
        shown.palm.x = row.distance_m * sign * 0.24f * std::cos(1.25f * t);
        if (side == Side::Left) shown.palm.z *= 0.85f;
    }
    shown.roll = sign * -row.turn * std::sin(2.1f * t);
    shown.tilt = 0.6f * row.turn * std::sin(1.5f * t);
    return shown;
}

cv::Mat taken(HandClip& clip, const Row& row, const std::array<std::optional<HandPose>, 2>& poses, int number,
              cv::RNG& random) {
    ImageRgba8 hands = clip.hands(poses);
    std::function<void(cv::Mat&)> paint;
    if (row.trouble == Trouble::Backlight) {
        paint = drawWindow;
        cv::Mat drawn(hands.height, hands.width, CV_8UC4, hands.pixels.data());
        cv::multiply(drawn, cv::Scalar(0.3, 0.3, 0.3, 1), drawn);
    } else if (row.trouble == Trouble::SkinWall) {
        paint = drawSkinWall;
    } else if (row.trouble == Trouble::SwayingFace) {
        paint = [number](cv::Mat& picture) { drawPerson(picture, cvRound(70 * std::sin(0.07 * number))); };
    } else if (row.face) {
        paint = [](cv::Mat& picture) { drawPerson(picture, 0); };
    }
    cv::Mat picture = clip.picture(hands, row.behind, paint);
    if (row.trouble == Trouble::Sleeves)
        for (const auto& pose : poses)
            if (pose) drawSleeve(picture, *pose);
    if (row.blur_px > 1) cv::blur(picture, picture, {row.blur_px, 1});
    if (row.light < 1) {
        cv::Mat noise(picture.size(), CV_16SC3);
        random.fill(noise, cv::RNG::NORMAL, 0, 5);
        picture.convertTo(picture, -1, row.light);
        cv::add(picture, noise, picture, {}, CV_8U);
    }
    return picture;
}

double apart_mm(const HandPose& a, const HandPose& b) { // of palms, across
    return 1e3 * glm::distance(glm::vec2(a.joints[0].position), glm::vec2(b.joints[0].position));
}

// Returns a hand of the rig's size that looks like one of another size, by moving it nearer or farther.
Shown asRig(Shown shown, float size) {
    shown.palm /= size;
    return shown;
}

void judge(const std::array<std::optional<HandPose>, 2>& shown, const HandFrame& frame, RowResult& result) {
    const std::array<HandPose, 2>& seen = frame.hands;
    std::array<bool, 2> used{};
    for (size_t side = 0; side < 2; ++side) {
        if (!shown[side]) continue;
        ++result.shown;
        for (const size_t as : {side, 1 - side}) {
            if (!seen[as].tracked || used[as] || apart_mm(*shown[side], seen[as]) > 60) continue;
            used[as] = true;
            ++result.found;
            result.otherSide += as != side;
            const auto wrist_m = [](const HandPose& hand) {
                return static_cast<double>(glm::length(hand.joints[kWristJoint].position));
            };
            result.wristRatio.push_back(wrist_m(seen[as]) / wrist_m(*shown[side]));
            for (const FingerJoints& finger : kFingerJoints) {
                const auto reach = [&](const HandPose& hand) {
                    return hand.joints[finger.tip].position - hand.joints[kWristJoint].position;
                };
                result.tips_mm.push_back(1e3 * glm::distance(reach(*shown[side]), reach(seen[as])));
            }
            break;
        }
    }
    for (size_t side = 0; side < 2; ++side) result.phantoms += seen[side].tracked && !used[side];
}

} // namespace

const std::vector<Row>& rows() {
    static const std::vector<Row> kRows = {
        {"one hand at 0.5 m"},
        {"both hands", Behind::Room, 0.5f, true},
        {"left hand", Behind::Gradient, 0.5f, true, false},
        {"near, 0.3 m", Behind::Room, 0.3f},
        {"far, 0.9 m", Behind::Room, 0.9f},
        {"before wood", Behind::Wood},
        {"beside a face", Behind::Room, 0.5f, true, true, true},
        {"blurred by 25 pixels", Behind::Room, 0.5f, false, true, false, 25},
        {"dark, a quarter", Behind::Room, 0.5f, false, true, false, 0, 0.25f},
        {"turned by a radian", Behind::Grey, 0.5f, false, true, false, 0, 1, 1.0f},
        {.name = "backlight", .trouble = Trouble::Backlight},
        {.name = "sleeves over the palm", .trouble = Trouble::Sleeves},
        {.name = "skin-coloured wall", .trouble = Trouble::SkinWall},
        {.name = "a face that sways", .left = true, .trouble = Trouble::SwayingFace},
        {.name = "crossing", .left = true, .trouble = Trouble::Crossing},
        {"a face, no hands", Behind::Room, 0.5f, false, false, true},
    };
    return kRows;
}

double medianOf(std::vector<double> values) { return values.empty() ? 1e9 : math::median(values); }

double RowResult::wristOff_percent(double knownSize) const {
    std::vector<double> off;
    for (const double ratio : wristRatio) off.push_back(100 * std::abs(ratio * knownSize - 1));
    return medianOf(off);
}

float measuredSize(HandClip& clip, const HandRig& rig, float size, LandmarkFinder& finder) {
    HandSizing sizing;
    for (int number = 0; number < 90 && sizing.state() != HandSizing::State::Done; ++number) {
        const float t = static_cast<float>(number) / 30;
        // The held hand moves by a few millimetres and degrees.
        const Shown held{.palm = HandSizing::kAt_m *
                                 glm::normalize(glm::vec3(0.02f * std::sin(2 * t), -0.1f, -1)),
                         .roll = 0.05f * std::sin(3 * t),
                         .tilt = 0.1f * std::sin(1.3f * t)};
        const std::array<std::optional<HandPose>, 2> drawn = {std::nullopt,
                                                              shownHand(rig, Side::Right, asRig(held, size))};
        const HandFrame frame =
            finder.detect(clip.picture(clip.hands(drawn), Behind::Room), number * kPicture_s);
        std::optional<float> rigDistance_m;
        for (const HandPose& hand : frame.hands)
            if (hand.tracked) rigDistance_m = glm::length(hand.joints[kPalmJoint].position);
        sizing.see(rigDistance_m, static_cast<float>(kPicture_s));
    }
    return sizing.size().value_or(0);
}

RowResult measure(HandClip& clip, const HandRig& rig, const Row& row, int pictures, LandmarkFinder& finder) {
    RowResult result;
    cv::RNG random(3);
    for (int number = 0; number < pictures; ++number) {
        std::array<std::optional<HandPose>, 2> shown, drawn;
        for (const Side side : {Side::Left, Side::Right}) {
            if (!(side == Side::Left ? row.left : row.right)) continue;
            const auto at = static_cast<size_t>(side);
            drawn[at] = shown[at] = shownHand(rig, side, asRig(shownAt(row, side, number), row.size));
            resize(*shown[at], row.size);
        }
        const cv::Mat picture = taken(clip, row, drawn, number, random);
        const auto began = std::chrono::steady_clock::now();
        const HandFrame frame = finder.detect(picture, number * kPicture_s);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - began;
        if (number >= kSettling) {
            judge(shown, frame, result);
            result.ms.push_back(took.count());
        }
    }
    return result;
}

} // namespace shoal::hands::test
