// Dynamic quality control: keeps frames within the display's period by drawing fewer pixels, then by making
// light less often, in steps too small to be seen. It takes the steps back when there is time again.
#pragma once

#include <algorithm>
#include <cmath>

namespace shoal::app {

struct Quality {
    float scale = 1;    // share of width and height that is drawn, then enlarged
    int lightEvery = 1; // makes light for each, every second ... frame of the video
};

class DynamicQuality {
  public:
    // budget_ms: time for a frame, from one refresh of the display to the next.
    explicit DynamicQuality(double budget_ms) : budget_ms_(budget_ms) {}

    // Takes the time of a frame's work, without the wait for the display; once a frame. It judges a quarter
    // of a second of frames, so that one slow frame changes nothing.
    void frame(double work_ms) {
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

    Quality quality() const {
        const int scaled = std::min(step_, kScaleSteps);
        return {std::max(kMinScale, static_cast<float>(std::pow(kStep, scaled))), 1 + step_ - scaled};
    }

    static constexpr float kMinScale = 0.5f;
    static constexpr int kMaxLightEvery = 4;

  private:
    static constexpr int kWindow = 15;      // frames judged together
    static constexpr double kStep = 0.94;   // factor on the width for each step: an eighth of the pixels
    static constexpr int kScaleSteps = 11;  // 0.94^11 = 0.506
    static constexpr double kFull = 0.95;   // share of the budget above which quality takes a step down
    static constexpr double kRoom = 0.78;   // share below which a step up fits, which costs an eighth more
    static constexpr int kMaxPatience = 64; // windows: a quarter of a minute at 60 frames a second

    double budget_ms_;
    int step_ = 0; // 0: full quality; larger: lower
    int frames_ = 0, late_ = 0;
    double sum_ms_ = 0;
    int patience_ = 8, calm_ = 0; // windows with spare time needed before a step up, and counted so far
    bool roseLast_ = false;       // the last step raised quality: if it fails at once, patience_ grows
};

} // namespace shoal::app
