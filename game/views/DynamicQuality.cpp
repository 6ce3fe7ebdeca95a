#include "game/views/DynamicQuality.h"

#include <algorithm>
#include <cmath>

namespace shoal::app {

namespace {

constexpr double kStep = 0.94;   // factor on the width for each step: an eighth of the pixels
constexpr int kScaleSteps = 11;  // 0.94^11 = 0.506
constexpr double kFull = 0.95;   // share of the budget above which quality takes a step down
constexpr double kRoom = 0.78;   // share below which a step up fits, which costs at most an eighth more
constexpr int kMaxPatience = 64; // windows: a quarter of a minute at 60 frames a second

} // namespace

void DynamicQuality::frame(double work_ms) {
    sum_ms_ += work_ms;
    late_ += work_ms > budget_ms_;
    if (++frames_ < kWindow) return;
    const double mean = sum_ms_ / frames_;
    const bool slow = mean > kFull * budget_ms_ || late_ * 4 > frames_;
    const bool room = mean < kRoom * budget_ms_ && late_ == 0;
    frames_ = late_ = 0;
    sum_ms_ = 0;

    constexpr int kSteps = kScaleSteps + kMaxLightEvery - 1;
    calm_ = room ? calm_ + 1 : 0;
    if (slow && step_ < kSteps) {
        if (roseLast_) patience_ = std::min(2 * patience_, kMaxPatience); // the step up was too early
        // Far over the budget it takes several steps at once, to end the stutter soon.
        const int steps = mean > 2 * budget_ms_ ? 4 : mean > 1.3 * budget_ms_ ? 2 : 1;
        step_ = std::min(step_ + steps, kSteps);
        roseLast_ = false;
    } else if (step_ > 0 && calm_ >= patience_) {
        if (roseLast_) patience_ = std::max(patience_ / 2, 8); // the last step up held
        --step_;
        roseLast_ = true;
        calm_ = 0;
    }
}

Quality DynamicQuality::quality() const {
    const int scaled = std::min(step_, kScaleSteps);
    return {std::max(kMinScale, static_cast<float>(std::pow(kStep, scaled))), 1 + step_ - scaled};
}

} // namespace shoal::app
