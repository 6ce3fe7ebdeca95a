// Dynamic quality control: keeps frames within the display's period by drawing fewer pixels, then by making
// light less often, in steps too small to be seen. It takes the steps back when there is time again.
#pragma once

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
    void frame(double work_ms);

    Quality quality() const;

    static constexpr float kMinScale = 0.5f;
    static constexpr int kMaxLightEvery = 4;

  private:
    static constexpr int kWindow = 15; // frames judged together

    double budget_ms_;
    int step_ = 0; // 0: full quality; larger: lower
    int frames_ = 0, late_ = 0;
    double sum_ms_ = 0;
    int patience_ = 8, calm_ = 0; // windows with spare time needed before a step up, and counted so far
    bool roseLast_ = false;       // the last step raised quality: if it fails at once, patience_ grows
};

} // namespace shoal::app
