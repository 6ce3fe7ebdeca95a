#include "game/app/FrameStudy.h"

#include <algorithm>

namespace shoal::app {

namespace {

// Widest map that objects mirror. For a moving video a quarter of the usual 2048: fish are rough and small,
// and show nothing finer. A still is made once, and may have all it has.
constexpr int kVideoLightWidth = 512;
constexpr int kStillLightWidth = 4096;

constexpr int kSmoothWidth = 32; // of the map that the light on bodies among each other is made from
constexpr int kLookEvery = 24;   // a camera stays what it is: one frame in so many tells enough

} // namespace

FrameStudy::FrameStudy(const Wanted& wanted)
    : mirrors_(wanted.mirrors),
      maker_({wanted.quality == light::LightQuality::Still ? kStillLightWidth : kVideoLightWidth,
              wanted.leastRoughness, wanted.quality}) {
    if (wanted.water) water_.emplace(wanted.eyeHeight_m);
    if (wanted.lights) lights_.emplace();
    if (wanted.look) look_.emplace();
}

// Of what made_ holds.
void FrameStudy::pack(FrameFindings& out) const {
    light::packLight(made_, mirrors_, out.light);
    const auto small = std::ranges::find_if(
        made_.radiance.levels, [](const ImageRgbF& level) { return level.width <= kSmoothWidth; });
    if (small != made_.radiance.levels.end()) out.smooth = occlusion::smoothLight(*small);
}

void FrameStudy::makeLight(const light::FrameView& frame, FrameFindings& out) {
    const int every = lightEvery_.load(std::memory_order_relaxed);
    if (++sinceLight_ < every && !newest_.light.places.empty()) {
        out = newest_;
        return;
    }
    sinceLight_ = 0;
    maker_.make(frame, made_);
    pack(out);
    if (water_) out.water = water_->estimate(frame);
    if (lights_) lights_->find(made_.radiance, out.lights);
    if (every > 1) newest_ = out;
}

void FrameStudy::study(const light::FrameView& frame, FrameFindings& out) {
    makeLight(frame, out);
    if (!look_) return;
    if (sinceLook_++ % kLookEvery == 0) lastLook_ = look_->estimate(frame);
    out.look = lastLook_;
    glow_.make(frame, out.glow);
}

size_t FrameStudy::study(const ImageRgbF& radianceLin, FrameFindings& out) {
    const size_t mended = maker_.makeFromHdr(radianceLin, made_).repairedTexels;
    pack(out);
    return mended;
}

} // namespace shoal::app
