// Environment of a dive: a video, photo or HDR picture around the player with the light made from it, as
// OpenGL textures. The thread of the OpenGL context; a video's frames are analysed on its decode thread.
#pragma once

#include "engine/core/Files.h"
#include "engine/depth/DepthRange.h"
#include "engine/depth/LightBeside.h"
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
    Path defaultVideo;          // played where the options name nothing
    bool bothEyes = false;      // a stereo picture shows each eye its own half; else all see the left one
    bool drawsDepth = true;     // else the video's distances are there for the rules alone
    bool roomIsSeen = false;    // shadows may fall on its floor, not only on what has distances
    bool waterIsCertain = true; // where the analysis looks for it; false: as far as the picture shows it
    AnalysisOptions analysis;
    // Called while something takes its time, a live video's first frame or a photo that is grown, with the
    // share that is done, 0 to 1, or -1 where nobody knows. False: wait no longer for a live video.
    std::function<bool(float)> wait;
};

// How reflectance is represented for the light of these; known before anything is opened.
render::Reflectance reflectanceIn(const EnvironmentOptions& options);

// The same options with the environment that a file holds, told by its content: an HDR picture, a photo, or
// else a video or live stream.
EnvironmentOptions environmentOf(const std::string& file, EnvironmentOptions options);

// Which file of a dive's film is played: the film itself, or beside NAME.mp4 the smaller NAME.small.mp4 if
// there is one.
Path filmFor(const Path& film, FilmChoice choice, bool slow);

class Environment {
  public:
    // Needs a current GL context. The first picture is there on return.
    static Result<std::unique_ptr<Environment>> open(const EnvironmentSetup& setup);

    // Shows what is due at this time of the video, seconds (it repeats for ever). exact: waits for just that
    // frame, so that equal times give equal pictures; else takes the newest complete one. Of what is live
    // always the newest, whatever the time. True if the picture changed.
    bool update(double time_s, bool exact);

    // As of the last update(). Water: none where the environment is dry.
    water::Water water() const { return water_.water(); }
    // Light that casts shadows, env frame; none unless asked for, and where there is nothing on which they
    // could fall.
    const light::ShadowLight& shadowLight() const { return casting_; }
    // Neutral unless asked for, and for an HDR picture.
    camera::CameraResponse cameraResponse() const { return cameraResponse_.response(); }
    // How far off what the frame shows is; null where nobody knows. Of a film with a picture for each eye, of
    // the left one's.
    const depth::DepthMap* depth() const { return gpu_[0].depth(); }
    // What light there is beside its camera; null where depth() is.
    const depth::LightBeside* lightBeside() const { return beside_; }
    // Whether distances come with the film.
    bool hasDepthTrack() const { return depthTrack_.has_value(); }
    // Of the video's frame, which counts on as the video repeats; -1: a still.
    int64_t frameIndex() const { return shownFrame_; }
    // Of the video, 0 for stills and what is live: what the last update() asked to be seen, counted from the
    // first picture of its pass.
    double videoPosition_s() const { return videoPosition_s_; }

    const Path& file() const { return file_; } // of the video; empty: a still, or live
    // Of a video, before it begins anew; 0: a still, or live.
    double length_s() const { return player_ ? player_->info().duration_s : 0; }

    // Makes light for every frame of the video (1), every second ...; the frames between keep the last.
    void setLightEvery(int frames) { analysis_->setLightEvery(frames); }

    // eye: 0 left, 1 right.
    const render::EnvironmentGpu& gpu(int eye) const {
        return gpu_[twoPictures_ ? static_cast<size_t>(eye) : 0];
    }
    bool eyesSeeTheSame() const { return !twoPictures_; } // no picture for each
    glm::mat3 envFromWorld() const;
    render::Exposure exposure(Tone chosen, float exposure_ev) const;

    // Of the newest frame; 0 for stills after the first.
    float light_ms() const { return light_ms_; }
    float decode_ms() const { return decode_ms_; }
    float upload_ms() const { return upload_ms_; }
    game::Text lightName() const;
    // When the video broke or has stopped; null: it plays.
    const game::Notice* notice() const { return notice_ ? &*notice_ : nullptr; }
    const media::LivePlayer* live() const { return live_ ? &*live_ : nullptr; } // null: a file

  private:
    explicit Environment(const EnvironmentSetup& setup)
        : setup_(setup), yaw_(glm::radians(setup.options.envYaw_deg)) {}
    Environment(const Environment&) = delete; // the decode thread knows where it is
    Environment& operator=(const Environment&) = delete;

    Status openVideo(const std::string& name); // a file, or something live
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
    // Made on the decode thread, slot by slot, and handed over with the frame. Before the player, whose
    // thread writes them until it is gone.
    std::vector<FrameFindings> found_;
    std::vector<ImageRgba8> pictures_; // the frames as they are uploaded
    struct Depth {
        depth::DepthMap map, widened;
        depth::DepthRange range;
        depth::LightBeside light;
    };
    std::vector<Depth> depths_;
    const depth::LightBeside* beside_ = nullptr; // of the frame shown
    std::optional<media::DepthTrack> depthTrack_;
    media::DepthFrame trackFrame_; // decoded last
    int trackFrameNumber_ = -1;
    depth::DepthRefiner depthRefiner_;
    Path file_;
    std::optional<media::VideoPlayer> player_;
    std::optional<media::LivePlayer> live_; // or this
    int64_t shownFrame_ = -1;
    water::WaterOverTime water_;
    light::LightOverTime lights_;
    light::ShadowLight casting_;
    camera::CameraResponseOverTime cameraResponse_;
    double lastUpdate_s_ = 0, videoPosition_s_ = 0;
    float light_ms_ = 0, decode_ms_ = 0, upload_ms_ = 0;
    std::optional<game::Notice> notice_;
    std::string liveNotice_; // for the log, with the reason
};

} // namespace shoal::app
