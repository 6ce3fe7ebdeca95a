// Dynamic quality control: keeps frames within the display's period by drawing fewer pixels, then by making
// light less often, in steps too small to be seen; reversed when there is time again.
#pragma once

namespace shoal::app {

struct Quality {
    float scale = 1;    // of the picture's width and height, as it is drawn before it is shown
    int lightEvery = 1; // make light for each, every second ... frame of the video
};

class DynamicQuality {
  public:
    // budget_ms: what a frame may take, from one refresh of the display to the next.
    explicit DynamicQuality(double budget_ms) : budget_ms_(budget_ms) {}

    // Once a frame, with what the frame's work took (not the waiting for the display). Looks back over a
    // quarter of a second of frames, so that one slow frame changes nothing.
    void frame(double work_ms);

    Quality quality() const;

    static constexpr float kMinScale = 0.5f;
    static constexpr int kMaxLightEvery = 4;

  private:
    static constexpr int kWindow = 15; // frames judged together

    double budget_ms_;
    int step_ = 0; // 0: everything; up: less
    int frames_ = 0, late_ = 0;
    double sum_ms_ = 0;
    int patience_ = 8, calm_ = 0; // windows with room that must pass before a step back up, and have passed
    bool roseLast_ = false;       // the last step was back up: if it fails at once, be more patient
};

} // namespace shoal::app
