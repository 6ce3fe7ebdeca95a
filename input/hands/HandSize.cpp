#include "input/hands/HandSize.h"

#include <algorithm>

namespace shoal::hands {

void resize(HandPose& hand, float size) {
    for (Joint& joint : hand.joints) {
        joint.position *= size;
        joint.radius *= size;
    }
}

void HandSizing::begin(float asRig_m) {
    held_s_ = 0;
    seen_ = 0;
    sum_m_ = 0;
    least_m_ = most_m_ = asRig_m;
}

void HandSizing::see(std::optional<float> asRig_m, float dt_s) {
    if (state_ == State::Done) return;
    if (!asRig_m) {
        missing_s_ += dt_s;
        if (missing_s_ < kMissing_s) return;
        begin(0);
        state_ = State::Waiting;
        return;
    }
    missing_s_ = 0;
    const auto size = static_cast<double>(kAt_m / std::max(*asRig_m, 1e-3f));
    if (size < kHandSizeMin || size > kHandSizeMax) {
        begin(0);
        state_ = State::Elsewhere;
        return;
    }
    if (state_ != State::Holding) begin(*asRig_m);
    state_ = State::Holding;
    least_m_ = std::min(least_m_, *asRig_m);
    most_m_ = std::max(most_m_, *asRig_m);
    if (most_m_ - least_m_ > kSpread * least_m_) begin(*asRig_m); // it moves
    sum_m_ += *asRig_m;
    ++seen_;
    held_s_ += dt_s;
    if (held_s_ >= kHold_s) state_ = State::Done;
}

std::optional<float> HandSizing::size() const {
    if (state_ != State::Done) return std::nullopt;
    return kAt_m * static_cast<float>(seen_) / sum_m_;
}

} // namespace shoal::hands
