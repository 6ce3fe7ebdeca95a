#include "engine/light/MakeLight.h"

#include <algorithm>
#include <chrono>

namespace shoal::light {

namespace {

// Milliseconds since it was made or last asked.
class Stopwatch {
  public:
    float lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<float, std::milli> passed = now - begin_;
        begin_ = now;
        return passed.count();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

void cutToHalf(ImageRgbF& image) {
    for (float& value : image.pixels) value = std::min(value, kMaxHalf);
}

} // namespace

LightMaker::LightMaker(LightOptions options) : options_(options) {}

LightReport LightMaker::make(const FrameView& frame, EnvironmentLight& out) {
    LightReport report;
    Stopwatch watch;
    pyramid_.make(frame, options_.baseWidth, out.radiance);
    report.pyramid_ms = watch.lap();
    finish(out, report);
    return report;
}

LightReport LightMaker::makeFromHdr(const ImageRgbF& radianceLin, EnvironmentLight& out) {
    LightReport report;
    Stopwatch watch;
    report.repairedTexels = pyramid_.make(radianceLin, options_.baseWidth, out.radiance);
    report.pyramid_ms = watch.lap();
    finish(out, report);
    // Display-coded frames end at 11.8.
    for (ImageRgbF& level : out.radiance.levels) cutToHalf(level);
    for (GlossyLevel& level : out.glossy) cutToHalf(level.radianceLin);
    cutToHalf(out.diffuse);
    return report;
}

void LightMaker::finish(EnvironmentLight& out, LightReport& report) {
    const int baseWidth = out.radiance.levels[0].width;
    if (!filters_ || filters_->baseWidth() != baseWidth)
        filters_.emplace(baseWidth, options_.minRoughness, options_.quality);
    Stopwatch watch;
    filters_->make(out);
    report.filter_ms = watch.lap();
}

} // namespace shoal::light
