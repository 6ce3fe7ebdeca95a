#include "engine/depth/estimate/MotionPass.h"

#include "engine/math/Quantile.h"

#include <algorithm>

namespace shoal::depth {

namespace {

constexpr int kMaxGap = 32;            // film frames between the two of a pair
constexpr double kGoodParallax = 0.02; // radians; more makes flow fail at edges

} // namespace

bool MotionPass::chooseGap() {
    constexpr int kPlaces = 8;
    const int64_t count = film_.info().frameCount;
    double bestScore = 0;
    int best = 0;
    for (int gap = kFilmStep; gap <= kMaxGap && gap < count; gap *= 2) {
        std::vector<double> parallaxes;
        int moving = 0;
        for (int place = 0; place < kPlaces; ++place) {
            const int64_t at = (count - gap - 1) * place / kPlaces;
            CubeFaces first, second;
            readFaces(at, first), readFaces(at + gap, second);
            const PairDepth pair = estimatePair(flow_, first, second);
            moving += isTranslation(pair.pose);
            parallaxes.push_back(pair.pose.parallax_rad);
        }
        const double parallax = math::median(parallaxes);
        if (moving * 3 >= kPlaces && moving * std::min(parallax, kGoodParallax) > bestScore)
            bestScore = moving * std::min(parallax, kGoodParallax), best = gap;
        if (best > 0 && parallax >= kGoodParallax) {
            best = gap;
            break;
        }
    }
    gap_ = best > 0 ? best : kFilmStep;
    return best > 0;
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
        const CubeFaces& first = facesAt(nextPair_); // before the second: faces are read in order
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
