// Analysis of the environment's frames: light maps, water, light sources and camera response. Runs on the
// decode thread.
#pragma once

#include "engine/camera/CameraResponse.h"
#include "engine/light/BruteForceDiffuse.h"
#include "engine/light/FindLights.h"
#include "engine/light/FrameView.h"
#include "engine/light/MakeLight.h"
#include "engine/light/PackedLight.h"
#include "engine/occlusion/SmoothLight.h"
#include "engine/water/EstimateWater.h"

#include <atomic>
#include <optional>

namespace shoal::environment {

struct FrameFindings {
    light::PackedLight light;
    occlusion::SmoothLight smooth; // for occlusion between bodies
    ImageRgbF radianceLin;         // small map, for the light at places beside the camera
    bool measured = false;         // whether the film tells how bright its lights are: PQ, HLG
    // The members below are empty unless AnalysisOptions asks for them:
    water::WaterEstimate water;
    light::FoundLights lights;
    camera::CameraResponseEstimate cameraResponse;
    camera::Glare glare;
};

struct AnalysisOptions {
    bool pyramid = false;   // keep the radiance pyramid too, for the thesis' glossy lookup
    float minRoughness = 0; // least roughness drawn: no light is made for smoother surfaces
    light::LightQuality quality = light::LightQuality::Video; // Still for stills
    light::DiffuseMethod diffuse = light::DiffuseMethod::Default;
    light::FrameRadiance frames = light::FrameRadiance::Auto;
    bool water = false;
    bool lights = false; // directions of the light sources, for shadows
    bool cameraResponse = false;

    bool operator==(const AnalysisOptions&) const = default;
};

class FrameAnalysis {
  public:
    explicit FrameAnalysis(const AnalysisOptions& options);

    // Analyses the frames in the order of the video. Allocates nothing once the findings have grown.
    // radianceLin: the same frame's light if it is known, else empty. The thesis' light is of coded values.
    void analyse(const light::FrameView& frame, const ImageRgbF& radianceLin, FrameFindings& out);

    // Makes the light alone, for an HDR picture.
    void analyse(const ImageRgbF& radianceLin, FrameFindings& out);

    // Makes light (and water and light sources) once in this many frames; others keep the last. Any thread.
    void setLightEvery(int frames) { lightEvery_.store(frames, std::memory_order_relaxed); }

  private:
    void makeLight(const light::FrameView& frame, const ImageRgbF& radianceLin, FrameFindings& out);
    void pack(light::TooBright tooBright, FrameFindings& out);

    light::MirrorMaps mirrors_;
    light::FrameRadiance frames_;
    light::LightMaker maker_;
    std::optional<light::BruteForceDiffuse> thesisDiffuse_;
    std::optional<water::WaterEstimator> water_;
    std::optional<light::LightFinder> lights_;
    std::optional<camera::CameraResponseEstimator> cameraResponse_;
    camera::GlareFilter glare_;
    light::EnvironmentLight made_; // light before packing
    FrameFindings newest_;         // last findings, while light is not made for every frame
    camera::CameraResponseEstimate lastCameraResponse_;
    int sinceLight_ = 0, sinceCameraResponse_ = 0;
    std::atomic<int> lightEvery_ = 1;
};

} // namespace shoal::environment
