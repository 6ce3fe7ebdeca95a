#include "content/make/depth/MotionPass.h"

#include "engine/math/Quantile.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::depth {

namespace {

constexpr int kMaxGap = 32;            // greatest distance between the frames of a pair, film frames
constexpr int kPlaces = 8;             // places of the film at which pairs are tried
constexpr double kGoodParallax = 0.03; // radians; more makes flow fail at edges
// Minimum cosine between the directions of movement found with one gap and with twice the gap. Caustics move
// over a floor, and frames close in time mistake this for a movement of the camera. With twice the gap the
// direction found then differs by 18 degrees or more on the reef. The camera itself turns by up to 11 degrees
// in that time (tests/bench/depth_estimate).
constexpr double kSameWay = 0.978; // cosine of 12 degrees

// Result of trying pairs of frames with one gap.
struct Tried {
    int gap = kFilmStep;
    std::vector<RelativePose> poses; // one for each place
    double parallax_rad = 0;         // median
    int moving = 0;                  // number of poses that are translations

    bool moves() const { return moving * 3 >= kPlaces; }
    double score() const { return moving * std::min(parallax_rad, kGoodParallax); }
};

Tried triedOf(int gap, std::vector<RelativePose> poses) {
    std::vector<double> parallaxes;
    int moving = 0;
    for (const RelativePose& pose : poses) {
        moving += isTranslation(pose);
        parallaxes.push_back(pose.parallax_rad);
    }
    return {gap, std::move(poses), math::median(parallaxes), moving};
}

// Returns true if the directions of movement agree at three of four places.
bool goTheSameWay(const Tried& a, const Tried& b) {
    std::vector<double> cosines;
    for (size_t i = 0; i < a.poses.size(); ++i)
        if (isTranslation(a.poses[i]) && isTranslation(b.poses[i]))
            cosines.push_back(glm::dot(a.poses[i].towards, b.poses[i].towards));
    return !cosines.empty() && math::quantile(cosines, 0.25) > kSameWay;
}

} // namespace

// Finds the poses of pairs with that gap, at the same places of the film for every gap up to the longest.
std::vector<RelativePose> MotionPass::posesOverFilm(int gap, int64_t longest) {
    std::vector<RelativePose> poses;
    for (int place = 0; place < kPlaces; ++place) {
        const int64_t at = (film_.info().frameCount - longest - 1) * place / kPlaces;
        CubeFaces first, second;
        readFaces(at, first), readFaces(at + gap, second);
        poses.push_back(estimatePair(flow_, first, second).pose);
    }
    return poses;
}

// A gap is good if points move far enough and pairs twice as far apart agree. If none is good, the gap that
// shows most movement is taken, of equal ones the shortest.
bool MotionPass::chooseGap() {
    const int64_t longest = std::min<int64_t>(kMaxGap, film_.info().frameCount / 2);
    Tried best, before; // begin without any movement
    for (int gap = kFilmStep; gap <= longest; gap *= 2) {
        Tried tried = triedOf(gap, posesOverFilm(gap, longest));
        if (before.moves() && before.parallax_rad >= kGoodParallax && goTheSameWay(before, tried)) {
            best = before;
            break;
        }
        if (tried.moves() && tried.score() > best.score()) best = tried;
        before = std::move(tried);
    }
    gap_ = best.gap;
    return best.moving > 0;
}

const CubeFaces& MotionPass::facesAt(int number) {
    if (faces_.empty()) firstFaces_ = number;
    while (firstFaces_ + static_cast<int>(faces_.size()) <= number) {
        faces_.emplace_back();
        readFaces(int64_t{firstFaces_ + static_cast<int>(faces_.size()) - 1} * kFilmStep, faces_.back());
    }
    while (firstFaces_ < number - step()) faces_.pop_front(), ++firstFaces_;
    return faces_[static_cast<size_t>(number - firstFaces_)];
}

FrameRecord MotionPass::frame(int number) {
    if (nextPair_ < 0) firstPair_ = nextPair_ = std::max(number - step(), 0);
    for (; nextPair_ <= number && nextPair_ + step() < film_.trackCount(); ++nextPair_) {
        const CubeFaces& first = facesAt(nextPair_); // called first: frames are read in order
        pairs_.push_back(estimatePair(flow_, first, facesAt(nextPair_ + step())));
    }
    while (firstPair_ < number - step()) pairs_.pop_front(), ++firstPair_;
    const auto pair = [&](int k) {
        const int at = k - firstPair_;
        return at >= 0 && at < static_cast<int>(pairs_.size()) ? &pairs_[static_cast<size_t>(at)] : nullptr;
    };
    return joined(pair(number), pair(number - step()));
}

} // namespace shoal::depth
