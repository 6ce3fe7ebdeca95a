#include "engine/environment/Player.h"

#include "engine/core/Log.h"
#include "engine/environment/PhotoEnvironment.h"
#include "engine/media/MediaKind.h"
#include "engine/media/Pictures.h"
#include "engine/media/StereoView.h"

#include <atomic>
#include <chrono>
#include <future>

namespace shoal::environment {

namespace {

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
        return environmentFrom(
            file, std::move(photo->picture), photo->metadata,
            {.layout = layout, .progress = [&](double done) { share = static_cast<float>(done); }});
    });
    while (reading.wait_for(std::chrono::milliseconds(30)) != std::future_status::ready)
        if (wait) wait(share);
    return reading.get();
}

} // namespace

Status setFile(Source& source, const std::string& file) {
    const auto live = media::liveAddress(file);
    if (!live) return live.error();
    const auto kind = file.empty() || *live ? media::MediaKind::Video : media::mediaKind(file);
    if (!kind) return kind.error();
    if (*kind == media::MediaKind::DepthTrack)
        return Error{file, "is the depth of a film; give the film beside it"};
    source.video = source.photo = source.env = {};
    (*kind == media::MediaKind::Hdr     ? source.env
     : *kind == media::MediaKind::Photo ? source.photo
                                        : source.video) = file;
    return Done{};
}

Result<std::unique_ptr<Player>> Player::open(const Setup& setup, const Wait& wait) {
    std::unique_ptr<Player> player(new Player(setup));
    const Status opened = !setup.source.photo.empty() ? player->openPhoto(wait)
                          : !setup.source.env.empty() ? player->openHdr()
                                                      : player->openVideo(wait);
    if (!opened) return opened.error();
    player->update(0, true);
    return player;
}

Status Player::openVideo(const Wait& wait) {
    const std::string& name = setup_.source.video;
    const auto address = media::liveAddress(name);
    if (!address) return address.error();
    if (!*address && setup_.source.depth) openDepth();
    prepareFor(setup_.analysis.quality, media::kFrameSlots);
    media::PlayerOptions options{.layout = setup_.source.layout, .keepPixels = false};
    options.prepare = [this](const media::VideoFrame& frame) { prepare(frame); };
    if (*address)
        return media::LivePlayer::open(media::feedFrom(**address), {options},
                                       [&] { return !wait || wait(-1); })
            .moveTo(live_);
    file_ = name;
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
    analysis_->analyse(leftEyeOf(photo->picture, layout_, false), frames_[0].found);
    light_ms_ = millisecondsSince(began);
    media::toBgra(photo->picture, false, frames_[0].picture);
    follow(0);
    return Done{};
}

Status Player::openHdr() {
    auto picture = media::readHdr(setup_.source.env);
    if (!picture) return picture.error();
    hdr_ = true;
    prepareFor(light::LightQuality::Still, 1);
    const auto began = std::chrono::steady_clock::now();
    analysis_->analyse(picture->radianceLin, frames_[0].found);
    light_ms_ = millisecondsSince(began);
    if (const std::string repairs = picture->repairs(); !repairs.empty())
        log::warn("{}: {}", setup_.source.env, repairs);
    frames_[0].radianceLin = std::move(picture->radianceLin);
    if (setup_.analysis.lights) casting_ = lights_.follow(frames_[0].found.lights, 0);
    return Done{};
}

void Player::prepareFor(light::LightQuality quality, size_t slots) {
    setup_.analysis.quality = quality;
    setup_.analysis.frames = setup_.source.light;
    setup_.analysis.lights =
        setup_.analysis.lights && ((hasDepthTrack() && setup_.drawsDepth) || setup_.roomIsSeen);
    analysis_.emplace(setup_.analysis);
    frames_.resize(slots);
    shown_ = frames_.data();
}

// Opens the film's depth track. The depth stays unknown if the track is missing or broken.
void Player::openDepth() {
    const Path film = setup_.source.video, file = media::depthTrackOf(film);
    std::error_code missing;
    if (!std::filesystem::exists(file, missing)) return;
    if (Status s = media::DepthTrack::open(file, film).moveTo(depthTrack_); !s)
        log::warn("{}; the film is shown without depth", s.error().message());
}

// Refines the depth of a frame; on the decode thread.
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

// Analyses a frame; on the decode thread.
void Player::prepare(const media::VideoFrame& frame) {
    const light::FrameView leftEye = leftEyeOf(frame.pixelsBgr, frame.layout, true);
    Frame& made = frames_[frame.slot];
    analysis_->analyse(leftEye, made.found);
    if (depthTrack_ && setup_.drawsDepth) prepareDepth(frame, leftEye);
    made.found.cameraResponse.response.chromaTexels = glm::min(frame.chromaTexels, 2);
    media::toBgra(frame.pixelsBgr, true, made.picture);
}

bool Player::update(double time_s, bool exact) {
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
    const media::VideoFrame* frame = exact ? player_->waitFor(time_s) : player_->newest(time_s);
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
    layout_ = frame.layout;
    light_ms_ = static_cast<float>(frame.prepare_ms);
    decode_ms_ = static_cast<float>(frame.decode_ms);
    return true;
}

// Smooths the findings over time; called for every drawn picture, so that light is smoother than the video.
void Player::follow(double time_s) {
    const AnalysisOptions& wanted = setup_.analysis;
    const FrameFindings& now = shown_->found;
    const auto dt_s = static_cast<float>(time_s - lastUpdate_s_);
    lastUpdate_s_ = time_s;
    if (wanted.water) water_.follow(now.water, setup_.waterIsCertain ? 1 : now.water.evidence, dt_s);
    if (wanted.lights) casting_ = lights_.follow(now.lights, dt_s);
    if (wanted.cameraResponse) {
        cameraResponse_.follow(now.cameraResponse, dt_s);
        cameraResponse_.followGlare(now.glare.maxShare, dt_s);
    }
}

} // namespace shoal::environment
