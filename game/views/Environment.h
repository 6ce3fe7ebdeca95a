// Environment of a dive: a video, photo or HDR picture around the player and the light made from it, as
// OpenGL textures. Used on the thread of the OpenGL context; the decode thread analyses a video's frames.
#pragma once

#include "engine/core/Files.h"
#include "engine/depth/DepthRange.h"
#include "engine/depth/LightDifference.h"
#include "engine/light/LightOverTime.h"
#include "engine/media/VideoPlayer.h"
#include "engine/media/live/LivePlayer.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/View.h"
#include "game/settings/SharedOptions.h"
#include "game/texts/Texts.h"
#include "game/views/FrameAnalysis.h"

#include <glm/mat3x3.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace shoal::app {

struct EnvironmentSetup {
    EnvironmentOptions options;
    Path defaultVideo;          // video if the options name no environment
    bool bothEyes = false;      // each eye sees its half of a stereo picture; else both see the left one
    bool drawsDepth = true;     // else only the rules use the video's distances
    bool roomIsSeen = false;    // the room shows, and shadows may fall on its floor without distances
    bool waterIsCertain = true; // trust the analysis' water; false: only as far as the picture shows it
    AnalysisOptions analysis;
    // Called while opening takes time, a live video's first frame or a photo that is grown, with the share
    // done, 0 to 1, or -1 if unknown. Returns false to stop waiting for a live video.
    std::function<bool(float)> wait;
};

// Returns how reflectance is represented for the light of this environment; before it is opened.
render::Reflectance reflectanceIn(const EnvironmentOptions& options);

// Returns the options with the file as environment, by its content: an HDR picture, a photo, or else a video
// or live stream.
EnvironmentOptions environmentOf(const std::string& file, EnvironmentOptions options);

// Returns the file of a dive's film to play: the film itself, or NAME.small.mp4 beside NAME.mp4 if there is
// one.
Path filmFor(const Path& film, FilmChoice choice, bool slow);

class Environment {
  public:
    // Opens an environment, with its first picture. Needs a current GL context.
    static Result<std::unique_ptr<Environment>> open(const EnvironmentSetup& setup);

    // Shows the video's frame at a time, seconds; the video repeats for ever. exact: waits for just that
    // frame, so that equal times give equal pictures; else takes the newest complete one. A live video always
    // shows its newest frame. Returns whether the picture changed.
    bool update(double time_s, bool exact);

    // The water as of the last update(), as all below; none if the environment is dry.
    water::Water water() const { return water_.water(); }
    // Light that casts shadows, env frame; none unless the setup asks for it and there is something to cast
    // on.
    const light::ShadowLight& shadowLight() const { return casting_; }
    // Response of the camera; neutral unless the setup asks for it, and for an HDR picture.
    camera::CameraResponse cameraResponse() const { return cameraResponse_.response(); }
    // Distances to what the frame shows; null: unknown. For a stereo film, those of the left picture.
    const depth::DepthMap* depth() const { return gpu_[0].depth(); }
    // Light at places beside the camera; null if depth() is.
    const depth::LightDifference* lightDifference() const { return lightDifference_; }
    // Whether a depth track comes with the film.
    bool hasDepthTrack() const { return depthTrack_.has_value(); }
    // Number of the video's frame, which counts on as the video repeats; -1: a still.
    int64_t frameIndex() const { return shownFrame_; }
    // Time in the video that the last update() showed, seconds from the first picture of its pass; 0 for
    // stills and live videos.
    double videoPosition_s() const { return videoPosition_s_; }

    const Path& file() const { return file_; } // the video's file; empty: a still, or live
    // Length of a pass of the video; 0: a still, or live.
    double length_s() const { return player_ ? player_->info().duration_s : 0; }

    // Makes light for every frame of the video (1), every second ...; the frames between keep the last.
    void setLightEvery(int frames) { analysis_->setLightEvery(frames); }

    // eye: 0 left, 1 right.
    const render::EnvironmentGpu& gpu(int eye) const {
        return gpu_[twoPictures_ ? static_cast<size_t>(eye) : 0];
    }
    bool eyesSeeTheSame() const { return !twoPictures_; } // both eyes see one picture
    glm::mat3 envFromWorld() const;
    render::Exposure exposure(Tone chosen, float exposure_ev) const;

    // Times for the newest frame; 0 for stills after the first.
    float light_ms() const { return light_ms_; }
    float decode_ms() const { return decode_ms_; }
    float upload_ms() const { return upload_ms_; }
    game::Text lightName() const;
    // The message when the video broke or has stopped; null: it plays.
    const game::Notice* notice() const { return notice_ ? &*notice_ : nullptr; }
    const media::LivePlayer* live() const { return live_ ? &*live_ : nullptr; } // null: a file

  private:
    explicit Environment(const EnvironmentSetup& setup)
        : setup_(setup), yaw_(glm::radians(setup.options.envYaw_deg)) {}
    Environment(const Environment&) = delete; // the decode thread holds its address
    Environment& operator=(const Environment&) = delete;

    Status openVideo(const std::string& name); // name: a file or a live address
    Status openPhoto(const Path& file);
    Result<ImageRgb8> readPhoto(const Path& file, bool grow) const;
    Status openEnv(const Path& file);
    void prepareFor(light::LightQuality quality, size_t slots);
    void openDepth(const Path& film);
    void prepare(const media::VideoFrame& frame);
    void prepareDepth(const media::VideoFrame& frame, const light::FrameView& leftEye);
    bool updateLive(double time_s);
    void setLayout(media::Layout layout);
    void follow(const FrameFindings& now, double time_s);
    bool show(const media::VideoFrame& frame, double time_s);
    void uploadPicture(size_t slot);
    void uploadLight(const FrameFindings& now);

    EnvironmentSetup setup_;
    float yaw_; // radians, to the right
    bool hdr_ = false;
    std::array<render::EnvironmentGpu, 2> gpu_; // per eye; the second only where each eye has its own picture
    bool twoPictures_ = false;
    media::Layout layout_ = media::Layout::Mono;

    std::optional<FrameAnalysis> analysis_;
    // Findings made on the decode thread, slot by slot, and handed over with the frame. Declared before the
    // player, whose thread writes them until it is destroyed.
    std::vector<FrameFindings> found_;
    std::vector<ImageRgba8> pictures_; // the frames in the layout of the upload
    struct Depth {
        depth::DepthMap map, widened;
        depth::DepthRange range;
        depth::LightDifference light;
    };
    std::vector<Depth> depths_;
    const depth::LightDifference* lightDifference_ = nullptr; // of the frame shown
    std::optional<media::DepthTrack> depthTrack_;
    media::DepthFrame trackFrame_; // the last one decoded
    int trackFrameNumber_ = -1;
    depth::DepthRefiner depthRefiner_;
    Path file_;
    std::optional<media::VideoPlayer> player_;
    std::optional<media::LivePlayer> live_; // instead of player_
    int64_t shownFrame_ = -1;
    water::WaterOverTime water_;
    light::LightOverTime lights_;
    light::ShadowLight casting_;
    camera::CameraResponseOverTime cameraResponse_;
    double lastUpdate_s_ = 0, videoPosition_s_ = 0;
    float light_ms_ = 0, decode_ms_ = 0, upload_ms_ = 0;
    std::optional<game::Notice> notice_;
    std::string liveNotice_; // the last live notice in the log, with the reason
};

} // namespace shoal::app
