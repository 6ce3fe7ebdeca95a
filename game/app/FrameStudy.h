// What is found out about each frame of the surround, its light above all: on the thread that decodes it.
#pragma once

#include "engine/camera/EstimateLook.h"
#include "engine/camera/Glow.h"
#include "engine/light/FindLights.h"
#include "engine/light/FrameView.h"
#include "engine/light/MakeLight.h"
#include "engine/light/PackedLight.h"
#include "engine/occlusion/SmoothLight.h"
#include "engine/water/EstimateWater.h"

#include <atomic>
#include <optional>

namespace shoal::app {

struct FrameFindings {
    light::PackedLight light;
    occlusion::SmoothLight smooth; // of bodies among each other
    // Empty unless asked for:
    water::WaterEstimate water;
    light::FoundLights lights;
    camera::LookEstimate look;
    camera::Glow glow;
};

class FrameStudy {
  public:
    struct Wanted {
        light::MirrorMaps mirrors = light::MirrorMaps::None;
        float leastRoughness = 0; // of all that will be drawn: no light is made for smoother things
        light::LightQuality quality = light::LightQuality::Video;
        bool water = false;
        std::optional<float> eyeHeight_m; // of the camera above the floor, where known
        bool lights = false;              // where it comes from
        bool look = false;                // what the camera did
    };
    explicit FrameStudy(const Wanted& wanted);

    // Frames in the order of the video. Allocates nothing once the findings have grown.
    void study(const light::FrameView& frame, FrameFindings& out);

    // The light alone. Returns how many of its values were no light and were mended.
    size_t study(const ImageRgbF& radianceLin, FrameFindings& out);

    // Light for every frame (1), every second ...; the frames between keep the last. From any thread.
    void setLightEvery(int frames) { lightEvery_.store(frames, std::memory_order_relaxed); }

  private:
    void makeLight(const light::FrameView& frame, FrameFindings& out);
    void pack(FrameFindings& out) const;

    light::MirrorMaps mirrors_;
    light::LightMaker maker_;
    std::optional<water::WaterEstimator> water_;
    std::optional<light::LightFinder> lights_;
    std::optional<camera::LookEstimator> look_;
    camera::GlowMaker glow_;
    light::EnvironmentLight made_; // before it is packed
    FrameFindings newest_;         // while light is not made for every frame
    camera::LookEstimate lastLook_;
    int sinceLight_ = 0, sinceLook_ = 0;
    std::atomic<int> lightEvery_ = 1;
};

} // namespace shoal::app
