#include "game/app/Surround.h"

#include "engine/camera/Glow.h"
#include "engine/camera/LookOverTime.h"
#include "engine/core/Log.h"
#include "engine/light/MakeLight.h"
#include "engine/media/Pictures.h"
#include "engine/media/StereoView.h"
#include "engine/media/VideoPlayer.h"
#include "engine/media/live/LivePlayer.h"
#include "engine/water/WaterOverTime.h"
#include "game/app/PhotoSurround.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <vector>

namespace shoal::app {

namespace {

// Widest map that objects mirror. For a moving video a quarter of the usual 2048: fish are rough and small,
// and show nothing finer. A still is made once, and may have all it has.
constexpr int kVideoLightWidth = 512;
constexpr int kStillLightWidth = 4096;

constexpr int kSlots = 3;
constexpr int kSmoothWidth = 32; // of the map that the light on bodies among each other is made from

media::Layout layoutNamed(const std::string& name) {
    if (name == "mono") return media::Layout::Mono;
    if (name == "top-bottom") return media::Layout::TopBottom;
    if (name == "left-right") return media::Layout::LeftRight;
    return media::Layout::Auto;
}

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

struct Surround::State {
    light::MirrorMaps mirrors = light::MirrorMaps::None;
    float leastRoughness = 0;
    bool bothEyes = false;
    float yaw = 0; // radians, to the right
    bool hdr = false;
    std::array<render::SurroundGpu, 2> gpu;     // per eye; the second only where each eye has its own picture
    std::array<render::CodedFrame, 2> inMemory; // what they show
    bool twoPictures = false;
    media::Layout layout = media::Layout::Mono;

    // Made on the decode thread, slot by slot, and handed over with the frame. Before the player, whose
    // thread writes them until it is gone.
    struct Prepared {
        light::PackedLight light;
        occlusion::SmoothLight smooth;
        water::WaterEstimate water;
        light::FoundLights lights;
        camera::LookEstimate look;
        camera::Glow glow; // empty unless the look is asked for
    };
    std::vector<Prepared> prepared;
    std::vector<ImageRgba8> pictures; // the frames as they are uploaded
    std::optional<light::LightMaker> maker;
    std::optional<water::WaterEstimator> waterEstimator; // empty: dry
    std::optional<light::LightFinder> lightFinder;       // empty: not asked for
    light::EnvironmentLight made;                        // before it is packed
    Prepared newest;                                     // while light is not made for every frame
    std::atomic<int> lightEvery = 1;
    int sinceLight = 0;
    std::optional<media::VideoPlayer> player;
    std::optional<media::LivePlayer> live; // or this
    int64_t shownFrame = -1;
    Immersed immersed = Immersed::No;
    water::WaterOverTime water;
    light::LightOverTime lights;
    light::CastingLight casting;
    std::optional<camera::LookEstimator> lookEstimator; // empty: nobody asks
    camera::GlowMaker glowMaker;
    camera::LookEstimate lastLook;
    int sinceLook = 0;
    camera::LookOverTime look;
    double lastUpdate_s = 0;
    double videoPosition_s = 0;
    float light_ms = 0, decode_ms = 0, upload_ms = 0;
    std::string notice;

    void setLayout(media::Layout found) {
        layout = found;
        twoPictures = bothEyes && found != media::Layout::Mono;
    }

    // All that is drawn is lit by the left eye's picture: the eyes' light differs by less than its own error.
    void uploadPicture(size_t slot) {
        const ImageRgba8& frame = pictures[slot];
        for (int eye = 0; eye < (twoPictures ? 2 : 1); ++eye) {
            const EyePart part = partOf(frame.width, frame.height, layout, eye);
            render::CodedFrame& coded = inMemory[static_cast<size_t>(eye)];
            coded = {frame.at(part.x, part.y), part.width, part.height, frame.width};
            gpu[static_cast<size_t>(eye)].uploadFrame(coded);
        }
        uploadLight(prepared[slot]);
    }

    void uploadLight(const Prepared& now) {
        for (int eye = 0; eye < (twoPictures ? 2 : 1); ++eye) {
            render::SurroundGpu& on = gpu[static_cast<size_t>(eye)];
            on.uploadLight(now.light, now.smooth);
            if (lookEstimator && !hdr) on.uploadScattered(now.glow.spread);
        }
    }

    // A camera stays what it is: one frame in so many tells enough.
    void findLook(const light::FrameView& frame, size_t slot) {
        if (!lookEstimator) return;
        constexpr int kEvery = 24;
        if (sinceLook++ % kEvery == 0) lastLook = lookEstimator->estimate(frame);
        prepared[slot].look = lastLook;
        glowMaker.make(frame, prepared[slot].glow);
    }

    void makeLight(const light::FrameView& frame, size_t slot) {
        const int every = lightEvery.load(std::memory_order_relaxed);
        if (++sinceLight < every && !newest.light.places.empty()) {
            prepared[slot] = newest;
            return;
        }
        sinceLight = 0;
        maker->make(frame, made);
        pack(prepared[slot]);
        if (waterEstimator) prepared[slot].water = waterEstimator->estimate(frame);
        if (lightFinder) lightFinder->find(made.radiance, prepared[slot].lights);
        if (every > 1) newest = prepared[slot];
    }

    // Of what `made` holds.
    void pack(Prepared& out) {
        light::packLight(made, mirrors, out.light);
        const auto small = std::ranges::find_if(
            made.radiance.levels, [](const ImageRgbF& level) { return level.width <= kSmoothWidth; });
        if (small != made.radiance.levels.end()) out.smooth = occlusion::smoothLight(*small);
    }

    void followWater(const water::WaterEstimate& estimate, float dt_s) {
        if (!waterEstimator) return;
        water.follow(estimate, immersed == Immersed::Yes ? 1 : estimate.evidence, dt_s);
    }

    // With every picture and not only with new frames: smoother than the video.
    void follow(const Prepared& now, double time_s) {
        const auto dt_s = static_cast<float>(time_s - lastUpdate_s);
        lastUpdate_s = time_s;
        followWater(now.water, dt_s);
        if (lightFinder) casting = lights.follow(now.lights, dt_s);
        if (lookEstimator) {
            look.follow(now.look, dt_s);
            look.followGlare(now.glow.mostShare, dt_s);
        }
    }

    // For a player with kSlots slots.
    void prepareFor(light::LightQuality quality) {
        const int most = quality == light::LightQuality::Still ? kStillLightWidth : kVideoLightWidth;
        maker.emplace(light::LightOptions{most, leastRoughness, quality});
        prepared.resize(kSlots);
        pictures.resize(kSlots);
    }

    void prepare(const ImageRgb8& bgr, const EyePart& part, int slot) {
        const light::FrameView frame = viewOf(bgr, part, true);
        makeLight(frame, static_cast<size_t>(slot));
        findLook(frame, static_cast<size_t>(slot));
        media::toBgra(bgr, true, pictures[static_cast<size_t>(slot)]);
    }

    // name: a file, or something live.
    Status openVideo(const std::string& name, media::Layout wish, light::LightQuality quality,
                     const std::function<bool()>& wait);
    Status openLive(const media::LiveAddress& address, media::Layout wish, const std::function<bool()>& wait);
    bool updateLive(double time_s);
    Status openFile(const Path& file, media::Layout wish);
    Status openPhoto(const Path& file, media::Layout wish);
    Status openEnv(const Path& file);
};

Status Surround::State::openVideo(const std::string& name, media::Layout wish, light::LightQuality quality,
                                  const std::function<bool()>& wait) {
    const auto address = media::liveAddress(name);
    if (!address) return address.error();
    prepareFor(quality);
    return *address ? openLive(**address, wish, wait) : openFile(name, wish);
}

Status Surround::State::openLive(const media::LiveAddress& address, media::Layout wish,
                                 const std::function<bool()>& wait) {
    auto opened =
        media::LivePlayer::open(media::feedFrom(address),
                                {.layout = wish,
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

bool Surround::State::updateLive(double time_s) {
    const media::LiveFrame& frame = *live->newest();
    if (notice != live->notice()) {
        notice = live->notice();
        notice.empty() ? log::info("pictures come again") : log::warn("{}", notice);
    }
    const auto slot = static_cast<size_t>(live->slotOf(frame));
    follow(prepared[slot], time_s);
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

Status Surround::State::openFile(const Path& file, media::Layout wish) {
    const auto info = media::inspectVideo(file, wish);
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

Status Surround::State::openPhoto(const Path& file, media::Layout wish) {
    auto picture = media::readPicture(file);
    if (!picture) return picture.error();
    if (wish == media::Layout::Auto) { // with a layout, somebody says that it is a surround
        auto full = surroundFrom(file, std::move(*picture), std::nullopt);
        if (!full) return full.error();
        picture = std::move(full->picture);
    }
    if (wish == media::Layout::Auto) wish = media::layoutFromShape(picture->width, picture->height);
    if (wish == media::Layout::Auto) wish = media::layoutFromContent(*picture);
    setLayout(wish);
    const EyePart part = partOf(picture->width, picture->height, layout, 0);
    maker.emplace(light::LightOptions{kStillLightWidth, leastRoughness, light::LightQuality::Still});
    prepared.resize(1);
    pictures.resize(1);
    const auto began = std::chrono::steady_clock::now();
    makeLight(viewOf(*picture, part, false), 0);
    light_ms = millisecondsSince(began);
    media::toBgra(*picture, false, pictures[0]);
    findLook(viewOf(*picture, part, false), 0);
    uploadPicture(0);
    follow(prepared[0], 0);
    return Done{};
}

Status Surround::State::openEnv(const Path& file) {
    auto picture = media::readHdr(file);
    if (!picture) return picture.error();
    hdr = true;
    maker.emplace(light::LightOptions{kStillLightWidth, leastRoughness, light::LightQuality::Still});
    prepared.resize(1);
    const auto began = std::chrono::steady_clock::now();
    const size_t mended = static_cast<size_t>(picture->repaired) +
                          maker->makeFromHdr(picture->radianceLin, made).repairedTexels;
    pack(prepared[0]);
    light_ms = millisecondsSince(began);
    if (mended)
        log::warn("{}: {} values were no light (negative, infinite or too large) and were mended",
                  file.string(), mended);
    gpu[0].uploadFrame(picture->radianceLin);
    uploadLight(prepared[0]);
    return Done{};
}

render::Reflectance reflectanceIn(const SurroundOptions& options) {
    const bool hdr = options.photo.empty() && !options.env.empty();
    return hdr ? render::Reflectance::Linear : render::Reflectance::Coded;
}

Result<Surround> Surround::open(const SurroundSetup& setup) {
    auto state = std::make_unique<State>();
    state->leastRoughness = setup.leastRoughness;
    state->mirrors = setup.pyramid                                           ? light::MirrorMaps::Pyramid
                     : setup.leastRoughness < light::kLeastFilteredRoughness ? light::MirrorMaps::Mirrors
                                                                             : light::MirrorMaps::None;
    state->bothEyes = setup.bothEyes;
    state->immersed = setup.immersed;
    if (setup.filmLook) state->lookEstimator.emplace();
    if (setup.immersed != Immersed::No) state->waterEstimator.emplace(setup.eyeHeight_m);
    if (setup.findLights) state->lightFinder.emplace();
    state->yaw = glm::radians(setup.options.envYaw_deg);
    const media::Layout wish = layoutNamed(setup.options.layout);
    const light::LightQuality quality = setup.still ? light::LightQuality::Still : light::LightQuality::Video;
    const std::string video = setup.options.video.empty() ? setup.defaultVideo.string() : setup.options.video;
    Status opened = !setup.options.photo.empty() ? state->openPhoto(setup.options.photo, wish)
                    : !setup.options.env.empty() ? state->openEnv(setup.options.env)
                                                 : state->openVideo(video, wish, quality, setup.wait);
    if (!opened) return opened.error();
    Surround surround(std::move(state));
    surround.update(0, true);
    return surround;
}

Surround::Surround(std::unique_ptr<State> state) : state_(std::move(state)) {}
Surround::Surround(Surround&&) noexcept = default;
Surround& Surround::operator=(Surround&&) noexcept = default;
Surround::~Surround() = default;

bool Surround::update(double time_s, bool exact) {
    State& s = *state_;
    if (s.live) return s.updateLive(time_s);
    if (!s.player) return false;
    const media::VideoFrame* frame = exact ? s.player->waitFor(time_s) : s.player->newest(time_s);
    if (std::string status = s.player->status(); !status.empty()) {
        log::warn("{}", status);
        s.notice = std::move(status);
    }
    const State::Prepared& prepared = s.prepared[static_cast<size_t>(s.player->slotOf(*frame))];
    s.follow(prepared, time_s);
    s.videoPosition_s = time_s - static_cast<double>(frame->index - frame->number) / s.player->info().fps;
    if (frame->index == s.shownFrame) return false;
    s.shownFrame = frame->index;
    const auto began = std::chrono::steady_clock::now();
    s.uploadPicture(static_cast<size_t>(s.player->slotOf(*frame)));
    s.upload_ms = millisecondsSince(began);
    s.light_ms = static_cast<float>(frame->prepare_ms);
    s.decode_ms = static_cast<float>(frame->decode_ms);
    return true;
}

water::Water Surround::water() const { return state_->water.water(); }
const light::CastingLight& Surround::castingLight() const { return state_->casting; }

camera::FilmLook Surround::filmLook() const { return state_->look.look(); }

int64_t Surround::frameIndex() const { return state_->shownFrame; }

double Surround::length_s() const { return state_->player ? state_->player->info().duration_s : 0; }

double Surround::videoPosition_s() const { return state_->videoPosition_s; }

void Surround::setLightEvery(int frames) { state_->lightEvery.store(frames, std::memory_order_relaxed); }

const render::CodedFrame* Surround::frameInMemory(int eye) const {
    return state_->hdr ? nullptr : &state_->inMemory[state_->twoPictures ? static_cast<size_t>(eye) : 0];
}

const render::SurroundGpu& Surround::gpu(int eye) const {
    return state_->gpu[state_->twoPictures ? static_cast<size_t>(eye) : 0];
}

bool Surround::eyesSeeTheSame() const { return !state_->twoPictures; }

glm::mat3 Surround::envFromWorld() const {
    // About +Y, positive angles turn towards the left: what lies yaw to the right comes ahead.
    return glm::mat3_cast(glm::angleAxis(state_->yaw, glm::vec3(0, 1, 0)));
}

render::ToneCurve Surround::naturalTone() const {
    return state_->hdr ? render::ToneCurve::Aces : render::ToneCurve::InverseOfVideo;
}

float Surround::light_ms() const { return state_->light_ms; }
float Surround::decode_ms() const { return state_->decode_ms; }
float Surround::upload_ms() const { return state_->upload_ms; }
std::string_view Surround::lightName() const {
    return state_->hdr ? "as measured, GGX prefiltered" : "thesis inverse tone mapping, GGX prefiltered";
}
std::string_view Surround::notice() const { return state_->notice; }
const media::LivePlayer* Surround::live() const { return state_->live ? &*state_->live : nullptr; }

} // namespace shoal::app
