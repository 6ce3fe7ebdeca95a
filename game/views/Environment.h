// Environment of a dive: a video, photo or HDR picture around the player with the light made from it, as
// OpenGL textures. The thread of the OpenGL context; a video's frames are analysed on its decode thread.
#pragma once

#include "engine/camera/CameraResponse.h"
#include "engine/core/Files.h"
#include "engine/light/LightOverTime.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"
#include "game/settings/SharedOptions.h"

#include <glm/mat3x3.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace shoal::media {
class LivePlayer;
}

namespace shoal::app {

// Whether the environment is under water.
enum class Immersed { No, IfItLooksSo, Yes };

struct EnvironmentSetup {
    EnvironmentOptions options;
    Path defaultVideo;     // played where the options name nothing
    bool bothEyes = false; // a stereo picture shows each eye its own half; else all see the left one
    bool still = false;    // one picture for good: as much light quality as a second buys
    bool pyramid = false;  // keep the radiance pyramid too, for the thesis' glossy lookup
    light::DiffuseMethod diffuse = light::DiffuseMethod::Default;
    float minRoughness = 0;           // of all that will be drawn: no light is made for smoother things
    Immersed immersed = Immersed::No; // an HDR picture never is
    bool cameraResponse = false;      // estimates it
    std::optional<float> eyeHeight_m; // of the camera above the floor, where known
    bool findLights = false;          // of a video, for shadows
    std::function<bool()> wait;       // false: stop waiting for the first frame of a live video
};

// How reflectance is represented for the light of these; known before anything is opened.
render::Reflectance reflectanceIn(const EnvironmentOptions& options);

class Environment {
  public:
    // Needs a current GL context. The first picture is there on return.
    static Result<Environment> open(const EnvironmentSetup& setup);
    Environment(Environment&&) noexcept;
    Environment& operator=(Environment&&) noexcept;
    ~Environment();

    // Shows what is due at this time of the video, seconds (it repeats for ever). exact: waits for just that
    // frame, so that equal times give equal pictures; else takes the newest complete one. Of what is live
    // always the newest, whatever the time. True if the picture changed.
    bool update(double time_s, bool exact);

    // As of the last update(); none where the environment is dry.
    water::Water water() const;

    // Light that casts shadows, as of the last update(); env frame. None unless asked for.
    const light::ShadowLight& shadowLight() const;

    // As of the last update(); neutral unless asked for, and for an HDR picture.
    camera::CameraResponse cameraResponse() const;

    // Of the video's frame, which counts on as the video repeats; -1: a still.
    int64_t frameIndex() const;

    // Of a video, before it begins anew; 0: a still, or live.
    double length_s() const;

    // Of the video, 0 for stills and what is live: what the last update() asked to be seen, counted from the
    // first picture of its pass.
    double videoPosition_s() const;

    // Makes light for every frame of the video (1), every second ...; the frames between keep the last.
    void setLightEvery(int frames);

    const render::EnvironmentGpu& gpu(int eye) const; // 0 left, 1 right
    bool eyesSeeTheSame() const;                      // no picture for each
    glm::mat3 envFromWorld() const;
    render::ToneCurve naturalTone() const; // the curve that `--tone auto` means here
    render::ToneCurve toneCurve(Tone chosen) const;

    // Of the newest frame; 0 for stills after the first.
    float light_ms() const;
    float decode_ms() const;
    float upload_ms() const;
    std::string_view lightName() const;
    std::string_view notice() const;       // one sentence when the video broke or has stopped; else empty
    const media::LivePlayer* live() const; // null: a file

  private:
    struct State;
    explicit Environment(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace shoal::app
