// What stands around the player: a video, a photo or an HDR picture, and the light made from it, on the
// graphics side.
#pragma once

#include "engine/camera/FilmLook.h"
#include "engine/core/Files.h"
#include "engine/light/LightOverTime.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/SurroundGpu.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"
#include "game/app/Options.h"

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

// Whether the surround lies under water.
enum class Immersed { No, IfItLooksSo, Yes };

struct SurroundSetup {
    SurroundOptions options;
    Path defaultVideo;        // played where the options name nothing
    bool bothEyes = false;    // a stereo picture shows each eye its own half; else all see the left one
    bool still = false;       // one picture for good: as much light quality as a second buys
    bool pyramid = false;     // keep the radiance pyramid too, for the thesis' glossy lookup
    float leastRoughness = 0; // of all that will be drawn: no light is made for smoother things
    Immersed immersed = Immersed::No; // an HDR picture never is
    bool filmLook = false;            // find out what the camera did to it
    std::optional<float> eyeHeight_m; // of the camera above the floor, where known
    bool findLights = false;          // of a video: where its light comes from, for shadows
    std::function<bool()> wait;       // of a live video: asked whether to go on waiting for its first picture
};

// The space that the light is in, known before anything is opened.
render::Reflectance reflectanceIn(const SurroundOptions& options);

class Surround {
  public:
    // Needs a current GL context. The first picture is there on return.
    static Result<Surround> open(const SurroundSetup& setup);
    Surround(Surround&&) noexcept;
    Surround& operator=(Surround&&) noexcept;
    ~Surround();

    // Shows what is due at this time of the video, seconds (it repeats for ever). exact: waits for just that
    // frame, so that equal times give equal pictures; else takes the newest complete one. Of what is live
    // always the newest, whatever the time. True if the picture changed.
    bool update(double time_s, bool exact);

    // Between the eye and all that is drawn, as of the last update(); none where the surround is dry.
    water::Water water() const;

    // What throws shadows, as of the last update(); env frame. Nothing unless asked for.
    const light::CastingLight& castingLight() const;

    // What its camera did to it, as of the last update(); nothing where that is not asked for, or an HDR
    // picture.
    camera::FilmLook filmLook() const;

    // Of the video's picture, counted on as it repeats; -1: a still.
    int64_t frameIndex() const;

    // Of a video, before it begins anew; 0: a still, or live.
    double length_s() const;

    // Of the video, 0 for stills and what is live: what the last update() asked to be seen, counted from the
    // first picture of its pass.
    double videoPosition_s() const;

    // Makes light for every frame of the video (1), every second ...; the frames between keep the last.
    void setLightEvery(int frames);

    const render::SurroundGpu& gpu(int eye) const; // 0 left, 1 right
    // The same picture where the processor can read it, until the next update(); null: an HDR picture.
    const render::CodedFrame* frameInMemory(int eye) const;
    bool eyesSeeTheSame() const; // no picture for each
    glm::mat3 envFromWorld() const;
    render::ToneCurve naturalTone() const; // the curve that `--tone auto` means here

    // Of the newest frame; 0 for stills after the first.
    float light_ms() const;
    float decode_ms() const;
    float upload_ms() const;
    std::string_view lightName() const;
    std::string_view notice() const;       // one sentence when the video broke or has stopped; else empty
    const media::LivePlayer* live() const; // null: a file

  private:
    struct State;
    explicit Surround(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace shoal::app
