#include "engine/environment/Player.h"

#include "engine/core/Log.h"
#include "engine/environment/PhotoEnvironment.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"

#include <chrono>
#include <future>

namespace shoal::environment {

namespace {

// Maximum width of the map for mirror reflections. For a video a quarter of the usual 2048: fish are rough
// and small, and show nothing finer. A still is analysed once, at its full resolution.
constexpr int kVideoLightWidth = 512;
constexpr int kStillLightWidth = 4096;

constexpr int kBesideWidth = 64;         // width of the map for light beside the camera
constexpr int kSmoothWidth = 32;         // width of the map for light in occlusion
constexpr int kCameraResponseEvery = 24; // frames between estimates: a camera hardly changes

// Returns the left eye's picture. Its light serves both eyes: theirs differ by less than the light's error.
light::FrameView leftEyeOf(const ImageRgb8& frame, media::Layout layout, bool bgr) {
    const media::EyePart part = media::eyePart(layout, 0, frame.width, frame.height);
    return {frame.at(part.x, part.y), part.width, part.height, static_cast<ptrdiff_t>(frame.width) * 3, bgr};
}

float millisecondsSince(std::chrono::steady_clock::time_point began) {
    return std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began).count();
}

// Reads a photo, and makes an environment of it, on a thread of its own.
Result<PhotoEnvironment<ImageRgb8>> readEnvironment(const Path& file, media::Layout layout,
                                                    const Wait& wait) {
    std::atomic<float> share = 0;
    auto reading = std::async(std::launch::async, [&]() -> Result<PhotoEnvironment<ImageRgb8>> {
        auto photo = media::readPhoto(file);
        if (!photo) return photo.error();
        if (const std::string note = photo->note(); !note.empty())
            log::info("{}: {}", file.string(), note.substr(2));
        return environmentFrom(
            file, std::move(photo->picture), photo->metadata,
            {.layout = layout, .progress = [&](double done) { share = static_cast<float>(done); }});
    });
    while (reading.wait_for(std::chrono::milliseconds(30)) != std::future_status::ready)
        if (wait) wait(share);
    return reading.get();
}

} // namespace

void setFile(Source& source, const std::string& file) {
    source.video = source.photo = source.env = {};
    const auto kind = media::mediaKind(file);
    (kind && *kind == media::MediaKind::Hdr     ? source.env
     : kind && *kind == media::MediaKind::Photo ? source.photo
                                                : source.video) = file;
}

Status checkLayer(const Source& source) {
    if (source.layer.empty() || source.isHdr()) return Done{};
    return Error{source.photo + source.video, media::kNoLayers};
}

Result<std::unique_ptr<Player>> Player::open(const Setup& setup, const Wait& wait) {
    const Source& source = setup.source;
    if (const Status s = checkLayer(source); !s) return s.error();
    std::unique_ptr<Player> player(new Player(setup));
    const Status opened = !source.photo.empty() ? player->openPhoto(wait)
                          : source.isHdr()      ? player->openHdr()
                                                : player->openVideo(wait);
    if (!opened) return opened.error();
    player->update(0, true);
    return player;
}

Status Player::openVideo(const Wait& wait) {
    const std::string& name = setup_.source.video;
    const auto address = media::liveAddress(name);
    if (!address) return address.error();
    const Path track = media::depthTrackOf(name);
    std::error_code missing;
    if (!*address && setup_.source.depth && std::filesystem::exists(track, missing))
        if (Status s = media::DepthTrack::open(track, name).moveTo(depthTrack_); !s)
            log::warn("{}; the film is shown without depth", s.error().message());
    prepareFor(setup_.quality, media::kFrameSlots);
    media::PlayerOptions options{.layout = setup_.source.layout,
                                 .decoding = setup_.decoding,
                                 .keepPixels = false,
                                 .keepPlanes = setup_.planes};
    options.prepare = [this](const media::VideoFrame& frame) { prepare(frame); };
    if (*address)
        return media::LivePlayer::open(media::feedFrom(**address), {options},
                                       [&] { return !wait || wait(-1); })
            .moveTo(live_);
    if (const Status opened = media::VideoPlayer::open(name, options).moveTo(player_); !opened) return opened;
    const media::VideoInfo& info = player_->info();
    if (info.layout != media::Layout::Mono && std::string_view(info.layoutSource) == "content")
        log::info(
            "{}: taken for two eyes' pictures, {}, because its halves are alike; --layout says otherwise",
            name, enumName(info.layout));
    envFromFilm_ = info.metadata.envFromFilm;
    if (const std::string note = info.metadata.note(); !note.empty())
        log::info("{}: {}", name, note.substr(2));
    return Done{};
}

Status Player::openPhoto(const Wait& wait) {
    auto photo = readEnvironment(setup_.source.photo, setup_.source.layout, wait);
    if (!photo) return photo.error();
    layout_ = photo->layout;
    envFromFilm_ = photo->envFromPhoto;
    prepareFor(light::LightQuality::Still, 1);
    const auto began = std::chrono::steady_clock::now();
    analyse(leftEyeOf(photo->picture, layout_, false), {}, frames_[0].found);
    light_ms_ = millisecondsSince(began);
    media::toBgra(photo->picture, false, frames_[0].picture);
    follow(0);
    return Done{};
}

Status Player::openHdr() {
    auto picture = media::readHdr(setup_.source.env, {}, setup_.source.layer);
    if (!picture) return picture.error();
    prepareFor(light::LightQuality::Still, 1);
    const auto began = std::chrono::steady_clock::now();
    lightMaker_.makeFromHdr(picture->radianceLin, made_);
    pack(light::TooBright::Scale, frames_[0].found);
    light_ms_ = millisecondsSince(began);
    if (const std::string note = picture->note(); !note.empty())
        log::info("{}: {}", setup_.source.env, note.substr(2));
    frames_[0].radianceLin = std::move(picture->radianceLin);
    if (setup_.lights) casting_ = lights_.follow(frames_[0].found.lights, 0);
    return Done{};
}

void Player::prepareFor(light::LightQuality quality, size_t slots) {
    setup_.quality = quality;
    setup_.lights = setup_.lights && ((hasDepthTrack() && setup_.drawsDepth) || setup_.roomIsSeen);
    lightMaker_ =
        light::LightMaker({quality == light::LightQuality::Still ? kStillLightWidth : kVideoLightWidth,
                           setup_.minRoughness, quality, setup_.source.light});
    thesisDiffuse_ = light::BruteForceDiffuse(setup_.diffuseWidth);
    frames_.resize(slots);
    shown_ = frames_.data();
}

// Refines the depth of a frame.
void Player::prepareDepth(const media::VideoFrame& frame, const light::FrameView& leftEye) {
    const int number = depthTrack_->frameAt(frame.time_s);
    if (number != trackFrameNumber_ && depthTrack_->read(number, trackFrame_)) trackFrameNumber_ = number;
    if (trackFrameNumber_ < 0) return;
    Frame& made = frames_[frame.slot];
    depthRefiner_.refine(trackFrame_, leftEye, made.depth);
    depth::widenNear(made.depth, made.widened);
    made.depthRange.make(made.depth);
    made.lightDifference.make(made.found.radianceLin, made.depth);
}

void Player::prepare(const media::VideoFrame& frame) {
    const light::FrameView leftEye = leftEyeOf(frame.pixelsBgr, frame.layout, true);
    Frame& made = frames_[frame.slot];
    analyse(leftEye, leftEyeOf(frame.radianceLin, frame.layout, leftRadianceLin_), made.found);
    if (depthTrack_ && setup_.drawsDepth) prepareDepth(frame, leftEye);
    made.found.cameraResponse.response.chromaTexels = glm::min(frame.chromaTexels, 2);
    made.planes = frame.planes.codes[0] ? &frame.planes : nullptr;
    if (!made.planes) media::toBgra(frame.pixelsBgr, true, made.picture);
}

void Player::analyse(const light::FrameView& frame, const ImageRgbF& radianceLin, FrameFindings& out) {
    makeLight(frame, radianceLin, out);
    if (!setup_.cameraResponse) return;
    if (sinceResponse_++ % kCameraResponseEvery == 0) lastResponse_ = responseEstimator_.estimate(frame);
    out.cameraResponse = lastResponse_;
    glare_.make(frame, out.glare);
}

void Player::makeLight(const light::FrameView& frame, const ImageRgbF& radianceLin, FrameFindings& out) {
    const int every = lightEvery_.load(std::memory_order_relaxed);
    if (++sinceLight_ < every && !newest_.light.places.empty()) {
        out = newest_;
        return;
    }
    sinceLight_ = 0;
    out.measured = !radianceLin.empty() && light::takesMeasured(setup_.source.light);
    if (out.measured)
        lightMaker_.makeFromHdr(radianceLin, made_);
    else
        lightMaker_.make(frame, made_);
    pack(light::TooBright::Cut, out);
    if (setup_.water) out.water = water::estimateWater(frame);
    if (setup_.lights) lightFinder_.find(made_.radiance, out.lights);
    if (every > 1) newest_ = out;
}

// Packs made_ into out. The map of roughness 1 is the diffuse map too.
void Player::pack(light::TooBright tooBright, FrameFindings& out) {
    if (setup_.diffuse == light::DiffuseMethod::Thesis) {
        thesisDiffuse_.make(made_.radiance, made_.diffuse);
        made_.glossy.back().radianceLin = made_.diffuse;
    }
    light::packLight(made_,
                     setup_.pyramid                                       ? light::MirrorMaps::Pyramid
                     : setup_.minRoughness < light::kMinFilteredRoughness ? light::MirrorMaps::Mirrors
                                                                          : light::MirrorMaps::None,
                     out.light, tooBright);
    out.smooth = occlusion::smoothLight(made_.radiance.ofWidth(kSmoothWidth));
    out.radianceLin = made_.radiance.ofWidth(kBesideWidth);
}

bool Player::update(double time_s, bool exactFrame) {
    if (live_) {
        const media::VideoFrame& frame = *live_->newest();
        if (liveNotice_ != live_->notice()) {
            liveNotice_ = live_->notice();
            liveNotice_.empty() ? log::info("pictures come again") : log::warn("{}", liveNotice_);
            trouble_ = live_->state() == media::LiveState::Stopped ? Trouble::Stopped
                       : live_->state() == media::LiveState::Lost  ? Trouble::Lost
                                                                   : Trouble::None;
        }
        return show(frame, time_s);
    }
    if (!player_) return false;
    const media::VideoFrame* frame = exactFrame ? player_->waitFor(time_s) : player_->newest(time_s);
    if (const std::string status = player_->status(); !status.empty()) {
        log::warn("{}", status);
        trouble_ = Trouble::Damaged;
    }
    videoPosition_s_ = time_s - static_cast<double>(frame->index - frame->number) / player_->info().fps;
    return show(*frame, time_s);
}

// Makes this frame the one that is shown. Returns false if it was already.
bool Player::show(const media::VideoFrame& frame, double time_s) {
    shown_ = &frames_[frame.slot];
    follow(time_s);
    if (frame.index == shownIndex_) return false;
    shownIndex_ = frame.index;
    // Only frames that are shown count, so that equal times give equal pictures.
    if (!shown_->depth.inverse.empty())
        caustics_.follow(shown_->found.radianceLin, static_cast<float>(time_s - causticsAt_s_));
    causticsAt_s_ = time_s;
    layout_ = frame.layout;
    light_ms_ = static_cast<float>(frame.prepare_ms);
    decode_ms_ = static_cast<float>(frame.decode_ms);
    return true;
}

// Smooths the findings over time; called for every drawn picture, so that light is smoother than the video.
void Player::follow(double time_s) {
    const FrameFindings& now = shown_->found;
    const auto dt_s = static_cast<float>(time_s - lastUpdate_s_);
    lastUpdate_s_ = time_s;
    if (setup_.water) water_.follow(now.water, setup_.waterIsCertain ? 1 : now.water.evidence, dt_s);
    if (setup_.lights) casting_ = lights_.follow(now.lights, dt_s);
    if (setup_.cameraResponse) {
        cameraResponse_.follow(now.cameraResponse, dt_s);
        cameraResponse_.followGlare(now.glare.maxShare, dt_s);
    }
}

} // namespace shoal::environment
