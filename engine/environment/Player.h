// Player of an environment (video, live video, photo or HDR picture), with the analysis of its frames.
#pragma once

#include "engine/camera/CameraResponse.h"
#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/depth/Caustics.h"
#include "engine/depth/DepthMap.h"
#include "engine/depth/LightDifference.h"
#include "engine/light/BruteForceDiffuse.h"
#include "engine/light/FindLights.h"
#include "engine/light/MakeLight.h"
#include "engine/light/PackedLight.h"
#include "engine/media/VideoPlayer.h"
#include "engine/media/live/LivePlayer.h"
#include "engine/occlusion/SmoothLight.h"
#include "engine/water/EstimateWater.h"

#include <glm/gtc/quaternion.hpp>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shoal::environment {

struct Source {
    std::string video, photo, env; // at most one; video: a file or a live address
    std::string layer;             // of an HDR picture: media::readHdr()
    media::Layout layout = media::Layout::Auto;
    light::FrameRadiance light = light::FrameRadiance::Auto;
    bool depth = true; // use the depth track beside the video, if there is one

    bool isHdr() const { return photo.empty() && !env.empty(); }

    bool operator==(const Source&) const = default;
};

// Sets the one member of the source that fits the file's content (media::mediaKind()): env for an HDR
// picture, photo for another picture, else video; if that cannot be shown, opening it gives the reason. An
// empty name leaves all three empty.
void setFile(Source& source, const std::string& file);

// Returns an error if a layer is named for a film or a photo, which have none.
Status checkLayer(const Source& source);

struct Setup {
    Source source;
    bool drawsDepth = true;     // false: only the game's rules use the video's distances
    bool roomIsSeen = false;    // the room shows: shadows may fall on its floor even without a depth track
    bool waterIsCertain = true; // take the estimated water as it is; false: weight it by its evidence
    bool pyramid = false;       // keep the radiance pyramid too, for the thesis' glossy lookup
    float minRoughness = 0;     // least roughness drawn: no light is made for smoother surfaces
    light::LightQuality quality = light::LightQuality::Video; // Still for stills
    light::DiffuseMethod diffuse = light::DiffuseMethod::Default;
    int diffuseWidth = light::BruteForceDiffuse::kThesisWidth; // of the thesis' map
    bool water = false;
    bool lights = false; // directions of the light sources, for shadows
    bool cameraResponse = false;
    bool planes = false; // a graphics card converts a film's frames, if it can read their planes
    media::Decoding decoding = media::Decoding::Sparing;

    bool operator==(const Setup&) const = default;
};

// Called while opening takes time (a live video's first frame, a photo that is grown) with the share done, 0
// to 1, or -1 if unknown. Returns false to stop waiting for a live video.
using Wait = std::function<bool(float)>;

// Trouble that leaves the last good picture shown. Damaged: a film's file. Stopped, Lost: media::LiveState.
enum class Trouble { None, Damaged, Stopped, Lost };

struct FrameFindings {
    light::PackedLight light;
    occlusion::SmoothLight smooth; // for occlusion between bodies
    ImageRgbF radianceLin;         // small map, for the light at places beside the camera
    bool measured = false;         // whether the film tells how bright its lights are: PQ, HLG
    // The members below are empty unless the setup asks for them:
    water::WaterEstimate water;
    light::FoundLights lights;
    camera::CameraResponseEstimate cameraResponse;
    camera::Glare glare;
};

struct Frame {
    ImageRgba8 picture; // pixels to upload, blue first; empty for an HDR picture, unused beside planes
    const media::Planes* planes = nullptr; // to upload instead of the picture, unless null
    ImageRgbF radianceLin;                 // only for an HDR picture
    FrameFindings found;
    depth::DepthMap depth, widened; // empty: unknown; of a stereo film's left picture; see widenNear()
    depth::DepthRange depthRange;
    depth::LightDifference lightDifference;
};

// One thread uses it; a video's frames are analysed on the decode thread.
class Player {
  public:
    // Opens an environment, with its first frame.
    static Result<std::unique_ptr<Player>> open(const Setup& setup, const Wait& wait = {});

    // Shows the video's frame at a time, seconds; the video repeats for ever. exactFrame: waits until that
    // frame is decoded, so that equal times give equal pictures; else takes the newest complete one. A live
    // video always shows its newest frame. Returns whether the frame changed.
    bool update(double time_s, bool exactFrame);

    // Returns the frame of the last update(), valid until the next; the functions below describe it too.
    const Frame& frame() const { return *shown_; }
    media::Layout layout() const { return layout_; }
    const glm::quat& envFromFilm() const { return envFromFilm_; } // how the file turns its sphere
    bool isHdr() const { return setup_.source.isHdr(); }
    water::Water water() const { return water_.water(); } // none if the environment is dry
    // Returns the light that casts shadows, env frame. There is none unless the setup asks for lights and
    // there are distances or a room's floor to cast shadows on.
    const light::ShadowLight& shadowLight() const { return casting_; }
    // Returns how waves change the light; of a film with distances.
    const depth::Caustics& caustics() const { return caustics_; }
    // Response of the camera; neutral unless the setup asks for it, and for an HDR picture.
    const camera::CameraResponse& cameraResponse() const { return cameraResponse_.response(); }
    bool hasDepthTrack() const { return depthTrack_.has_value(); }
    // Number of the video's frame, which counts on as the video repeats; -1: a still.
    int64_t frameIndex() const { return shownIndex_; }
    // Time in the video, seconds from the first picture of its pass; 0 for stills and live videos.
    double videoPosition_s() const { return videoPosition_s_; }
    Trouble trouble() const { return trouble_; }
    // Time of the newest frame's analysis, and of its decoding; a still keeps the time of its one analysis.
    float light_ms() const { return light_ms_; }
    float decode_ms() const { return decode_ms_; }

    Path file() const { return player_ ? Path(setup_.source.video) : Path(); } // empty: a still, or live
    // Length of a pass of the video; 0: a still, or live.
    double length_s() const { return player_ ? player_->info().duration_s : 0; }
    const media::LivePlayer* live() const { return live_ ? &*live_ : nullptr; } // null: a file

    // Makes light (and water and light sources) once in this many frames of the video; others keep the last.
    void setLightEvery(int frames) { lightEvery_.store(frames, std::memory_order_relaxed); }

  private:
    explicit Player(const Setup& setup) : setup_(setup) {}
    Player(const Player&) = delete; // the decode thread holds its address
    Player& operator=(const Player&) = delete;

    Status openVideo(const Wait& wait);
    Status openPhoto(const Wait& wait);
    Status openHdr();
    void prepareFor(light::LightQuality quality, size_t slots);
    // The decode thread calls these for a video's frames, in their order. They allocate nothing once their
    // buffers have grown.
    void prepare(const media::VideoFrame& frame);
    void prepareDepth(const media::VideoFrame& frame, const light::FrameView& leftEye);
    void analyse(const light::FrameView& frame, const ImageRgbF& radianceLin, FrameFindings& out);
    void makeLight(const light::FrameView& frame, const ImageRgbF& radianceLin, FrameFindings& out);
    void pack(light::TooBright tooBright, FrameFindings& out);
    void follow(double time_s);
    bool show(const media::VideoFrame& frame, double time_s);

    Setup setup_;
    media::Layout layout_ = media::Layout::Mono;
    glm::quat envFromFilm_{1, 0, 0, 0};
    // State of the analysis. It and the frames are declared before the players, whose threads write them.
    light::LightMaker lightMaker_;
    light::BruteForceDiffuse thesisDiffuse_;
    light::LightFinder lightFinder_;
    camera::CameraResponseEstimator responseEstimator_;
    camera::GlareFilter glare_;
    light::EnvironmentLight made_; // light before packing
    FrameFindings newest_;         // last findings, while light is not made for every frame
    camera::CameraResponseEstimate lastResponse_;
    int sinceLight_ = 0, sinceResponse_ = 0;
    std::atomic<int> lightEvery_ = 1;
    // Filled on the decode thread, one for each slot, and handed over with the video's frame.
    std::vector<Frame> frames_;
    ImageRgbF leftRadianceLin_; // of a stereo frame
    const Frame* shown_ = nullptr;
    std::optional<media::DepthTrack> depthTrack_;
    media::DepthFrame trackFrame_; // the last one decoded
    int trackFrameNumber_ = -1;
    depth::DepthRefiner depthRefiner_;
    std::optional<media::VideoPlayer> player_;
    std::optional<media::LivePlayer> live_; // instead of player_
    int64_t shownIndex_ = -1;
    water::WaterOverTime water_;
    light::LightOverTime lights_;
    light::ShadowLight casting_;
    depth::Caustics caustics_;
    double causticsAt_s_ = 0; // time of their last frame
    camera::CameraResponseOverTime cameraResponse_;
    double lastUpdate_s_ = 0, videoPosition_s_ = 0;
    float light_ms_ = 0, decode_ms_ = 0;
    Trouble trouble_ = Trouble::None;
    std::string liveNotice_; // the live player's notice that was logged last
};

} // namespace shoal::environment
