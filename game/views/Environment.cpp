#include "game/views/Environment.h"

#include "engine/camera/CameraResponseOverTime.h"
#include "engine/core/Log.h"
#include "engine/media/Pictures.h"
#include "engine/media/StereoView.h"
#include "engine/media/VideoPlayer.h"
#include "engine/media/live/LivePlayer.h"
#include "engine/water/WaterOverTime.h"
#include "game/views/FrameAnalysis.h"
#include "game/views/PhotoEnvironment.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

namespace shoal::app {

namespace {

constexpr int kSlots = 3;

// One eye's part of a frame, where it lies.
struct EyePart {
    int x = 0, y = 0, width = 0, height = 0;
};

EyePart partOf(int width, int height, media::Layout layout, int eye) {
    const media::EyeView view = media::eyeView(layout, eye);
    // Downwards: both eyes of an odd size fit in.
    const auto at = [](float share, int size) { return static_cast<int>(share * static_cast<float>(size)); };
    return {at(view.offset.x, width), at(view.offset.y, height), at(view.scale.x, width),
            at(view.scale.y, height)};
}

light::FrameView viewOf(const ImageRgb8& frame, const EyePart& part, bool bgr) {
    return {frame.at(part.x, part.y), part.width, part.height, static_cast<ptrdiff_t>(frame.width) * 3, bgr};
}

float millisecondsSince(std::chrono::steady_clock::time_point began) {
    return std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began).count();
}

} // namespace

struct Environment::State {
    bool bothEyes = false;
    float yaw = 0; // radians, to the right
    bool hdr = false;
    std::array<render::EnvironmentGpu, 2> gpu; // per eye; the second only where each eye has its own picture
    bool twoPictures = false;
    media::Layout layout = media::Layout::Mono;

    FrameAnalysis::Options wanted;
    std::optional<FrameAnalysis> analysis;
    // Made on the decode thread, slot by slot, and handed over with the frame. Before the player, whose
    // thread writes them until it is gone.
    std::vector<FrameFindings> found;
    std::vector<ImageRgba8> pictures; // the frames as they are uploaded
    std::optional<media::VideoPlayer> player;
    std::optional<media::LivePlayer> live; // or this
    int64_t shownFrame = -1;
    Immersed immersed = Immersed::No;
    water::WaterOverTime water;
    light::LightOverTime lights;
    light::ShadowLight casting;
    camera::CameraResponseOverTime cameraResponse;
    double lastUpdate_s = 0;
    double videoPosition_s = 0;
    float light_ms = 0, decode_ms = 0, upload_ms = 0;
    std::string notice;

    void setLayout(media::Layout now) {
        layout = now;
        twoPictures = bothEyes && now != media::Layout::Mono;
    }

    // All that is drawn is lit by the left eye's picture: the eyes' light differs by less than its own error.
    void uploadPicture(size_t slot) {
        const ImageRgba8& frame = pictures[slot];
        for (int eye = 0; eye < (twoPictures ? 2 : 1); ++eye) {
            const EyePart part = partOf(frame.width, frame.height, layout, eye);
            gpu[static_cast<size_t>(eye)].setFrame(
                {frame.at(part.x, part.y), part.width, part.height, frame.width});
        }
        uploadLight(found[slot]);
    }

    void uploadLight(const FrameFindings& now) {
        for (int eye = 0; eye < (twoPictures ? 2 : 1); ++eye) {
            render::EnvironmentGpu& on = gpu[static_cast<size_t>(eye)];
            on.uploadLight(now.light, now.smooth);
            if (wanted.cameraResponse && !hdr) on.uploadScattered(now.glare.spread);
        }
    }

    void followWater(const water::WaterEstimate& estimate, float dt_s) {
        if (!wanted.water) return;
        water.follow(estimate, immersed == Immersed::Yes ? 1 : estimate.evidence, dt_s);
    }

    // With every picture and not only with new frames: smoother than the video.
    void follow(const FrameFindings& now, double time_s) {
        const auto dt_s = static_cast<float>(time_s - lastUpdate_s);
        lastUpdate_s = time_s;
        followWater(now.water, dt_s);
        if (wanted.lights) casting = lights.follow(now.lights, dt_s);
        if (wanted.cameraResponse) {
            cameraResponse.follow(now.cameraResponse, dt_s);
            cameraResponse.followGlare(now.glare.maxShare, dt_s);
        }
    }

    void prepareFor(light::LightQuality quality, size_t slots) {
        wanted.quality = quality;
        analysis.emplace(wanted);
        found.resize(slots);
        pictures.resize(slots);
    }

    void prepare(const ImageRgb8& bgr, const EyePart& part, int slot) {
        analysis->analyse(viewOf(bgr, part, true), found[static_cast<size_t>(slot)]);
        media::toBgra(bgr, true, pictures[static_cast<size_t>(slot)]);
    }

    // name: a file, or something live.
    Status openVideo(const std::string& name, media::Layout request, light::LightQuality quality,
                     const std::function<bool()>& wait);
    Status openLive(const media::LiveAddress& address, media::Layout request,
                    const std::function<bool()>& wait);
    bool updateLive(double time_s);
    Status openFile(const Path& file, media::Layout request);
    Status openPhoto(const Path& file, media::Layout request);
    Status openEnv(const Path& file);
};

Status Environment::State::openVideo(const std::string& name, media::Layout request,
                                     light::LightQuality quality, const std::function<bool()>& wait) {
    const auto address = media::liveAddress(name);
    if (!address) return address.error();
    prepareFor(quality, kSlots);
    return *address ? openLive(**address, request, wait) : openFile(name, request);
}

Status Environment::State::openLive(const media::LiveAddress& address, media::Layout request,
                                    const std::function<bool()>& wait) {
    auto opened =
        media::LivePlayer::open(media::feedFrom(address),
                                {.layout = request,
                                 .slots = kSlots,
                                 .prepare =
                                     [this](const media::LiveFrame& frame, int slot) {
                                         const ImageRgb8& bgr = frame.pixelsBgr;
                                         prepare(bgr, partOf(bgr.width, bgr.height, frame.layout, 0), slot);
                                     },
                                 .keepPixels = false},
                                wait);
    if (!opened) return opened.error();
    live = std::move(*opened);
    return Done{};
}

bool Environment::State::updateLive(double time_s) {
    const media::LiveFrame& frame = *live->newest();
    if (notice != live->notice()) {
        notice = live->notice();
        notice.empty() ? log::info("pictures come again") : log::warn("{}", notice);
    }
    const auto slot = static_cast<size_t>(live->slotOf(frame));
    follow(found[slot], time_s);
    if (frame.index == shownFrame) return false;
    shownFrame = frame.index;
    setLayout(frame.layout);
    const auto began = std::chrono::steady_clock::now();
    uploadPicture(slot);
    upload_ms = millisecondsSince(began);
    light_ms = static_cast<float>(frame.prepare_ms);
    decode_ms = static_cast<float>(frame.decode_ms);
    return true;
}

Status Environment::State::openFile(const Path& file, media::Layout request) {
    const auto info = media::inspectVideo(file, request);
    if (!info) return info.error();
    setLayout(info->layout);
    const EyePart part = partOf(info->width, info->height, layout, 0);
    auto opened = media::VideoPlayer::open(
        file, {.layout = layout,
               .slots = kSlots,
               .prepare = [this, part](const media::VideoFrame& frame,
                                       int slot) { prepare(frame.pixelsBgr, part, slot); },
               .keepPixels = false});
    if (!opened) return opened.error();
    player = std::move(*opened);
    return Done{};
}

Status Environment::State::openPhoto(const Path& file, media::Layout request) {
    auto picture = media::readPicture(file);
    if (!picture) return picture.error();
    if (request == media::Layout::Auto) { // with a layout, somebody says that it is an environment
        auto full = environmentFrom(file, std::move(*picture), std::nullopt);
        if (!full) return full.error();
        picture = std::move(full->picture);
    }
    if (request == media::Layout::Auto) request = media::layoutFromShape(picture->width, picture->height);
    if (request == media::Layout::Auto) request = media::layoutFromContent(*picture);
    setLayout(request);
    const EyePart part = partOf(picture->width, picture->height, layout, 0);
    prepareFor(light::LightQuality::Still, 1);
    const auto began = std::chrono::steady_clock::now();
    analysis->analyse(viewOf(*picture, part, false), found[0]);
    light_ms = millisecondsSince(began);
    media::toBgra(*picture, false, pictures[0]);
    uploadPicture(0);
    follow(found[0], 0);
    return Done{};
}

Status Environment::State::openEnv(const Path& file) {
    auto picture = media::readHdr(file);
    if (!picture) return picture.error();
    hdr = true;
    prepareFor(light::LightQuality::Still, 1);
    const auto began = std::chrono::steady_clock::now();
    const size_t mended =
        static_cast<size_t>(picture->repaired) + analysis->analyse(picture->radianceLin, found[0]);
    light_ms = millisecondsSince(began);
    if (mended)
        log::warn("{}: {} values were no light (negative, infinite or too large) and were mended",
                  file.string(), mended);
    gpu[0].setFrame(picture->radianceLin);
    uploadLight(found[0]);
    return Done{};
}

render::Reflectance reflectanceIn(const EnvironmentOptions& options) {
    const bool hdr = options.photo.empty() && !options.env.empty();
    return hdr ? render::Reflectance::Linear : render::Reflectance::Coded;
}

Result<Environment> Environment::open(const EnvironmentSetup& setup) {
    auto state = std::make_unique<State>();
    state->wanted = {
        .mirrors = setup.pyramid                                       ? light::MirrorMaps::Pyramid
                   : setup.minRoughness < light::kMinFilteredRoughness ? light::MirrorMaps::Mirrors
                                                                       : light::MirrorMaps::None,
        .minRoughness = setup.minRoughness,
        .diffuse = setup.diffuse,
        .water = setup.immersed != Immersed::No,
        .eyeHeight_m = setup.eyeHeight_m,
        .lights = setup.findLights,
        .cameraResponse = setup.cameraResponse,
    };
    state->bothEyes = setup.bothEyes;
    state->immersed = setup.immersed;
    state->yaw = glm::radians(setup.options.envYaw_deg);
    const media::Layout request = setup.options.layout;
    const light::LightQuality quality = setup.still ? light::LightQuality::Still : light::LightQuality::Video;
    const std::string video = setup.options.video.empty() ? setup.defaultVideo.string() : setup.options.video;
    Status opened = !setup.options.photo.empty() ? state->openPhoto(setup.options.photo, request)
                    : !setup.options.env.empty() ? state->openEnv(setup.options.env)
                                                 : state->openVideo(video, request, quality, setup.wait);
    if (!opened) return opened.error();
    Environment environment(std::move(state));
    environment.update(0, true);
    return environment;
}

Environment::Environment(std::unique_ptr<State> state) : state_(std::move(state)) {}
Environment::Environment(Environment&&) noexcept = default;
Environment& Environment::operator=(Environment&&) noexcept = default;
Environment::~Environment() = default;

bool Environment::update(double time_s, bool exact) {
    State& s = *state_;
    if (s.live) return s.updateLive(time_s);
    if (!s.player) return false;
    const media::VideoFrame* frame = exact ? s.player->waitFor(time_s) : s.player->newest(time_s);
    if (std::string status = s.player->status(); !status.empty()) {
        log::warn("{}", status);
        s.notice = std::move(status);
    }
    const auto slot = static_cast<size_t>(s.player->slotOf(*frame));
    s.follow(s.found[slot], time_s);
    s.videoPosition_s = time_s - static_cast<double>(frame->index - frame->number) / s.player->info().fps;
    if (frame->index == s.shownFrame) return false;
    s.shownFrame = frame->index;
    const auto began = std::chrono::steady_clock::now();
    s.uploadPicture(slot);
    s.upload_ms = millisecondsSince(began);
    s.light_ms = static_cast<float>(frame->prepare_ms);
    s.decode_ms = static_cast<float>(frame->decode_ms);
    return true;
}

water::Water Environment::water() const { return state_->water.water(); }
const light::ShadowLight& Environment::shadowLight() const { return state_->casting; }

camera::CameraResponse Environment::cameraResponse() const { return state_->cameraResponse.response(); }

int64_t Environment::frameIndex() const { return state_->shownFrame; }

double Environment::length_s() const { return state_->player ? state_->player->info().duration_s : 0; }

double Environment::videoPosition_s() const { return state_->videoPosition_s; }

void Environment::setLightEvery(int frames) {
    if (state_->analysis) state_->analysis->setLightEvery(frames);
}

const render::EnvironmentGpu& Environment::gpu(int eye) const {
    return state_->gpu[state_->twoPictures ? static_cast<size_t>(eye) : 0];
}

bool Environment::eyesSeeTheSame() const { return !state_->twoPictures; }

glm::mat3 Environment::envFromWorld() const {
    // About +Y, positive angles turn towards the left: what lies yaw to the right comes ahead.
    return glm::mat3_cast(glm::angleAxis(state_->yaw, glm::vec3(0, 1, 0)));
}

render::ToneCurve Environment::naturalTone() const {
    return state_->hdr ? render::ToneCurve::Aces : render::ToneCurve::InverseOfVideo;
}

render::ToneCurve Environment::toneCurve(Tone chosen) const {
    if (chosen == Tone::Auto) return naturalTone();
    return chosen == Tone::Aces ? render::ToneCurve::Aces : render::ToneCurve::Linear;
}

float Environment::light_ms() const { return state_->light_ms; }
float Environment::decode_ms() const { return state_->decode_ms; }
float Environment::upload_ms() const { return state_->upload_ms; }
std::string_view Environment::lightName() const {
    return state_->hdr ? "as measured, GGX prefiltered" : "thesis inverse tone mapping, GGX prefiltered";
}
std::string_view Environment::notice() const { return state_->notice; }
const media::LivePlayer* Environment::live() const { return state_->live ? &*state_->live : nullptr; }

} // namespace shoal::app
