#include "input/hands/webcam/landmarks/HandNets.h"

#include "input/hands/HandTracker.h"

#include <fmt/ranges.h>
#include <opencv2/imgproc.hpp>

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

#include <algorithm>
#include <cmath>
#include <string_view>

namespace shoal::hands {

namespace {

constexpr int kPalmPicture = 192, kHandPicture = 224; // the networks' inputs, pixels
constexpr size_t kAnchors = 2016, kPerAnchor = 18;
constexpr float kPalmThreshold = 0.5f, kSamePalm = 0.3f; // score; overlap of boxes
constexpr size_t kMaxPalms = 8;
// The networks' outputs, in their files' order.
enum PalmOutput : size_t { kBoxes, kScores };
enum LandmarkOutput : size_t { kPlaces, kPresence, kRight, kShape };

std::string sha256(const std::vector<uint8_t>& bytes) {
    const std::unique_ptr<AVSHA, decltype(&av_free)> sha(av_sha_alloc(), av_free);
    std::array<uint8_t, 32> sum{};
    if (!sha || av_sha_init(sha.get(), 256) < 0) return {};
    av_sha_update(sha.get(), bytes.data(), bytes.size());
    av_sha_final(sha.get(), sum.data());
    return fmt::format("{:02x}", fmt::join(sum, ""));
}

Result<NeuralNet> loadNet(const Path& file, std::string_view checksum) {
    const auto bytes = readFile(file, 16u << 20);
    if (bytes && sha256(*bytes) == checksum) return NeuralNet::read(*bytes, file.string());
    return Error{file.string(),
                 (bytes ? std::string("is damaged, or of another version") : bytes.error().reason) + "; " +
                     handModelScript().string() + " fetches it"};
}

cv::Point2f turned(const cv::Point2f& v, float turn) {
    const float c = std::cos(turn), s = std::sin(turn);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

// Returns Crop::turn from the way from the wrist to the middle knuckle.
float turnOf(const cv::Point2f& way) { return std::atan2(way.x, -way.y); }

float overlap(const cv::Rect2f& a, const cv::Rect2f& b) {
    const float both = (a & b).area();
    return both / std::max(a.area() + b.area() - both, 1e-6f);
}

// Returns the middles of the detector's cells, 0 to 1: two in each cell of 8 pixels, then six in each of 16.
std::vector<cv::Point2f> makeAnchors() {
    std::vector<cv::Point2f> anchors;
    for (const auto& [cells, each] : {std::pair{24, 2}, std::pair{12, 6}})
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x)
                for (int i = 0; i < each; ++i)
                    anchors.emplace_back((static_cast<float>(x) + 0.5f) / static_cast<float>(cells),
                                         (static_cast<float>(y) + 0.5f) / static_cast<float>(cells));
    return anchors;
}

} // namespace

Crop cropAround(const Landmarks& hand) {
    // All landmarks but the tips, and the fingers' last joints, which move most.
    constexpr std::array kSteady = {0, 1, 2, 3, 5, 6, 9, 10, 13, 14, 17, 18};
    constexpr float kScale = 2.0f, kTowardsFingers = 0.1f;
    const auto& at = hand.at;
    const float turn = turnOf(0.25f * (at[5] + at[13]) + 0.5f * at[9] - at[0]);
    cv::Point2f low(1e9f, 1e9f), high(-1e9f, -1e9f);
    for (const int i : kSteady) {
        const cv::Point2f p = turned(at[i], -turn);
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const cv::Point2f extent = high - low;
    const cv::Point2f middle = 0.5f * (low + high) - cv::Point2f(0, kTowardsFingers * extent.y);
    return {turned(middle, turn), kScale * std::max(extent.x, extent.y), turn};
}

Result<HandNets> HandNets::load(const Path& folder) {
    HandNets nets;
    for (const auto& [net, file, checksum] :
         {std::tuple(&nets.palms_, "palm_detection_full.tflite",
                     "2f25e740121983f68ffc05f99991d524dc0ea812134f6316a26125816941ee85"),
          std::tuple(&nets.landmarks_, "hand_landmark_full.tflite",
                     "8c026882c9ec059ce0f8e75266bee5a9a23c341a40e0000df755374d3d1b9b68")})
        if (Status s = loadNet(folder / file, checksum).moveTo(*net); !s) return s.error();
    nets.anchors_ = makeAnchors();
    nets.found_.reserve(kAnchors);
    return nets;
}

// Fills a network's input, red first, 0 to 1, with the part of the picture that the affine map takes to it.
void HandNets::takePicture(const cv::Mat& bgr, const cv::Matx23f& inputFromPicture, int size, int border,
                           NeuralNet& net) {
    cv::Mat to(size, size, CV_32FC3, net.input.data());
    cv::warpAffine(bgr, part_, inputFromPicture, {size, size}, cv::INTER_LINEAR, border);
    cv::cvtColor(part_, rgb_, cv::COLOR_BGR2RGB);
    rgb_.convertTo(to, CV_32F, 1.0 / 255);
}

std::span<const FoundPalm> HandNets::findPalms(const cv::Mat& bgr) {
    // The network gets the whole picture, in the middle of a black square.
    const cv::Point2f size(static_cast<float>(bgr.cols), static_cast<float>(bgr.rows));
    const float side = std::max(size.x, size.y), scale = kPalmPicture / side;
    const cv::Point2f margin(0.5f * (side - size.x), 0.5f * (side - size.y));
    cv::resize(bgr, small_, {std::max(1, cvRound(size.x * scale)), std::max(1, cvRound(size.y * scale))}, 0,
               0, cv::INTER_AREA);
    takePicture(small_, {1, 0, margin.x * scale, 0, 1, margin.y * scale}, kPalmPicture, cv::BORDER_CONSTANT,
                palms_);
    if (!palms_.run()) return {};
    const std::span<const float> numbers = palms_.outputs[kBoxes], scores = palms_.outputs[kScores];
    found_.clear();
    for (size_t i = 0; i < kAnchors; ++i) {
        const float score = 1 / (1 + std::exp(-std::clamp(scores[i], -100.0f, 100.0f)));
        if (!(score >= kPalmThreshold)) continue;
        const float* of = &numbers[i * kPerAnchor];
        const auto point = [&](size_t k) { // pixels of the picture
            return cv::Point2f(of[k] / kPalmPicture + anchors_[i].x,
                               of[k + 1] / kPalmPicture + anchors_[i].y) *
                       side -
                   margin;
        };
        const cv::Point2f middle = point(0), extent = cv::Point2f(of[2], of[3]) * (side / kPalmPicture);
        const cv::Point2f wrist = point(4), knuckle = point(8);
        if (!(extent.x > 1 && extent.y > 1 && extent.x < 4 * side && extent.y < 4 * side)) continue;
        const float turn = turnOf(knuckle - wrist);
        constexpr float kScale = 2.6f, kTowardsFingers = 0.5f;
        found_.push_back({{middle + turned({0, -kTowardsFingers * extent.y}, turn),
                           kScale * std::max(extent.x, extent.y), turn},
                          cv::Rect2f(middle - 0.5f * extent, cv::Size2f(extent.x, extent.y)),
                          score});
    }
    // Non-maximum suppression, in place.
    std::ranges::sort(found_, std::ranges::greater(), &FoundPalm::score);
    size_t kept = 0;
    for (const FoundPalm& palm : found_) {
        const bool known = std::ranges::any_of(std::span(found_).first(kept), [&](const FoundPalm& other) {
            return overlap(other.box, palm.box) > kSamePalm;
        });
        if (!known && kept < kMaxPalms) found_[kept++] = palm;
    }
    return std::span(found_).first(kept);
}

Landmarks HandNets::findLandmarks(const cv::Mat& bgr, const Crop& crop) {
    // The map from the picture to the crop's own pixels turns it back about its middle.
    const float scale = kHandPicture / crop.size, half = 0.5f * kHandPicture;
    const cv::Point2f x = turned({scale, 0}, -crop.turn), y = turned({0, scale}, -crop.turn);
    takePicture(bgr,
                {x.x, y.x, half - x.x * crop.middle.x - y.x * crop.middle.y, //
                 x.y, y.y, half - x.y * crop.middle.x - y.y * crop.middle.y},
                kHandPicture, cv::BORDER_REPLICATE, landmarks_);
    Landmarks out;
    if (!landmarks_.run()) return out;
    const std::span<const float> at = landmarks_.outputs[kPlaces], shape = landmarks_.outputs[kShape];
    for (size_t i = 0; i < kLandmarkCount; ++i) {
        out.at[i] =
            crop.middle + turned(cv::Point2f(at[3 * i] - half, at[3 * i + 1] - half) / scale, crop.turn);
        const cv::Point2f across = turned({shape[3 * i], shape[3 * i + 1]}, crop.turn);
        out.shape[i] = {across.x, across.y, shape[3 * i + 2]};
    }
    out.presence = landmarks_.outputs[kPresence][0];
    out.right = landmarks_.outputs[kRight][0]; // in a picture that is not mirrored
    return out;
}

} // namespace shoal::hands
