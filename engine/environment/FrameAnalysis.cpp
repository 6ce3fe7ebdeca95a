#include "engine/environment/FrameAnalysis.h"

#include <algorithm>

namespace shoal::environment {

namespace {

// Maximum width of the map for mirror reflections. For a video a quarter of the usual 2048: fish are rough
// and small, and show nothing finer. A still is analysed once, at its full resolution.
constexpr int kVideoLightWidth = 512;
constexpr int kStillLightWidth = 4096;

constexpr int kBesideWidth = 64;         // greatest width of the map for light beside the camera
constexpr int kSmoothWidth = 32;         // greatest width of the map for light in occlusion
constexpr int kCameraResponseEvery = 24; // frames between estimates: a camera hardly changes

} // namespace

FrameAnalysis::FrameAnalysis(const AnalysisOptions& options)
    : mirrors_(options.pyramid                                       ? light::MirrorMaps::Pyramid
               : options.minRoughness < light::kMinFilteredRoughness ? light::MirrorMaps::Mirrors
                                                                     : light::MirrorMaps::None),
      frames_(options.frames),
      maker_({options.quality == light::LightQuality::Still ? kStillLightWidth : kVideoLightWidth,
              options.minRoughness, options.quality, options.frames}) {
    if (options.diffuse == light::DiffuseMethod::Thesis) thesisDiffuse_.emplace();
    if (options.water) water_.emplace();
    if (options.lights) lights_.emplace();
    if (options.cameraResponse) cameraResponse_.emplace();
}

// Packs made_ into out. The map of roughness 1 is the diffuse map too.
void FrameAnalysis::pack(light::TooBright tooBright, FrameFindings& out) {
    if (thesisDiffuse_) {
        thesisDiffuse_->make(made_.radiance, made_.diffuse);
        made_.glossy.back().radianceLin = made_.diffuse;
    }
    light::packLight(made_, mirrors_, out.light, tooBright);
    const auto levelOf = [&](int width) {
        return std::ranges::find_if(made_.radiance.levels,
                                    [=](const ImageRgbF& level) { return level.width <= width; });
    };
    const auto none = made_.radiance.levels.end();
    if (const auto small = levelOf(kSmoothWidth); small != none) out.smooth = occlusion::smoothLight(*small);
    if (const auto small = levelOf(kBesideWidth); small != none) out.radianceLin = *small;
}

void FrameAnalysis::makeLight(const light::FrameView& frame, const ImageRgbF& radianceLin,
                              FrameFindings& out) {
    const int every = lightEvery_.load(std::memory_order_relaxed);
    if (++sinceLight_ < every && !newest_.light.places.empty()) {
        out = newest_;
        return;
    }
    sinceLight_ = 0;
    out.measured = !radianceLin.empty() && frames_ != light::FrameRadiance::Thesis;
    if (out.measured)
        maker_.makeFromHdr(radianceLin, made_);
    else
        maker_.make(frame, made_);
    pack(light::TooBright::Cut, out);
    if (water_) out.water = water_->estimate(frame);
    if (lights_) lights_->find(made_.radiance, out.lights);
    if (every > 1) newest_ = out;
}

void FrameAnalysis::analyse(const light::FrameView& frame, const ImageRgbF& radianceLin, FrameFindings& out) {
    makeLight(frame, radianceLin, out);
    if (!cameraResponse_) return;
    if (sinceCameraResponse_++ % kCameraResponseEvery == 0)
        lastCameraResponse_ = cameraResponse_->estimate(frame);
    out.cameraResponse = lastCameraResponse_;
    glare_.make(frame, out.glare);
}

void FrameAnalysis::analyse(const ImageRgbF& radianceLin, FrameFindings& out) {
    maker_.makeFromHdr(radianceLin, made_);
    pack(light::TooBright::Scale, out);
}

} // namespace shoal::environment
