#include "game/views/Environment.h"

#include "engine/core/Log.h"
#include "engine/media/Pictures.h"
#include "engine/media/StereoView.h"
#include "game/views/PhotoEnvironment.h"

#include <glm/gtc/quaternion.hpp>

#include <atomic>
#include <chrono>
#include <future>

namespace shoal::app {

namespace {

// Returns the left eye's picture, which lights all: the eyes' light differs by less than its own error.
light::FrameView leftEyeOf(const ImageRgb8& frame, media::Layout layout, bool bgr) {
    const media::EyePart part = media::eyePart(layout, 0, frame.width, frame.height);
    return {frame.at(part.x, part.y), part.width, part.height, static_cast<ptrdiff_t>(frame.width) * 3, bgr};
}

std::optional<game::Notice> noticeOf(media::LiveState state) {
    switch (state) {
    case media::LiveState::Playing:
        break;
    case media::LiveState::Stopped:
        return game::Notice{"The live video has stopped; its last picture stays"};
    case media::LiveState::Lost:
        return game::Notice{"The live video was lost; its last picture stays until it comes back"};
    }
    return std::nullopt;
}

float millisecondsSince(std::chrono::steady_clock::time_point began) {
    return std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began).count();
}

} // namespace

render::Reflectance reflectanceIn(const EnvironmentOptions& options) {
    const bool hdr = options.photo.empty() && !options.env.empty();
    return hdr || options.light != light::FrameRadiance::Thesis ? render::Reflectance::Linear
                                                                : render::Reflectance::Coded;
}

EnvironmentOptions environmentOf(const std::string& file, EnvironmentOptions options) {
    options.video.clear();
    options.photo.clear();
    options.env.clear();
    const media::PictureContent content = media::pictureContent(file);
    std::string& which = content == media::PictureContent::Hdr     ? options.env
                         : content == media::PictureContent::Coded ? options.photo
                                                                   : options.video;
    which = file;
    return options;
}

Path filmFor(const Path& film, FilmChoice choice, bool slow) {
    Path small = film;
    small.replace_extension(".small" + film.extension().string());
    const bool wanted = choice == FilmChoice::Small || (choice == FilmChoice::Auto && slow);
    std::error_code missing;
    return wanted && std::filesystem::exists(small, missing) ? small : film;
}

Result<std::unique_ptr<Environment>> Environment::open(const EnvironmentSetup& setup) {
    std::unique_ptr<Environment> environment(new Environment(setup));
    const EnvironmentOptions& options = setup.options;
    const std::string video = options.video.empty() ? setup.defaultVideo.string() : options.video;
    const Status opened = !options.photo.empty() ? environment->openPhoto(options.photo)
                          : !options.env.empty() ? environment->openEnv(options.env)
                                                 : environment->openVideo(video);
    if (!opened) return opened.error();
    environment->update(0, true);
    return environment;
}

Status Environment::openVideo(const std::string& name) {
    const auto address = media::liveAddress(name);
    if (!address) return address.error();
    if (!*address && setup_.options.depth) openDepth(name);
    prepareFor(setup_.analysis.quality, media::kFrameSlots);
    media::PlayerOptions options{.layout = setup_.options.layout, .keepPixels = false};
    options.prepare = [this](const media::VideoFrame& frame) { prepare(frame); };
    if (*address)
        return media::LivePlayer::open(media::feedFrom(**address), {options},
                                       [this] { return !setup_.wait || setup_.wait(-1); })
            .moveTo(live_);
    file_ = name;
    if (const Status opened = media::VideoPlayer::open(name, options).moveTo(player_); !opened) return opened;
    const media::VideoInfo& info = player_->info();
    if (info.layout != media::Layout::Mono && std::string_view(info.layoutSource) == "content")
        log::info(
            "{}: taken for two eyes' pictures, {}, because its halves are alike; --layout says otherwise",
            name, enumName(info.layout));
    return Done{};
}

// Reads a photo, and grows it unless it is an environment, on a thread beside the loading screen.
Result<ImageRgb8> Environment::readPhoto(const Path& file, bool grow) const {
    std::atomic<float> share = 0;
    auto reading = std::async(std::launch::async, [&]() -> Result<ImageRgb8> {
        auto picture = media::readPicture(file);
        if (!picture || !grow) return picture;
        auto full = environmentFrom(file, std::move(*picture), std::nullopt,
                                    [&](double done) { share = static_cast<float>(done); });
        if (!full) return full.error();
        return std::move(full->picture);
    });
    while (reading.wait_for(std::chrono::milliseconds(30)) != std::future_status::ready)
        if (setup_.wait) setup_.wait(share);
    return reading.get();
}

Status Environment::openPhoto(const Path& file) {
    media::Layout layout = setup_.options.layout;
    const bool grow = layout == media::Layout::Auto; // a given layout says that it is an environment
    auto picture = readPhoto(file, grow);
    if (!picture) return picture.error();
    if (layout == media::Layout::Auto) layout = media::layoutOf(*picture);
    setLayout(layout);
    prepareFor(light::LightQuality::Still, 1);
    const auto began = std::chrono::steady_clock::now();
    analysis_->analyse(leftEyeOf(*picture, layout_, false), found_[0]);
    light_ms_ = millisecondsSince(began);
    media::toBgra(*picture, false, pictures_[0]);
    uploadPicture(0);
    follow(found_[0], 0);
    return Done{};
}

Status Environment::openEnv(const Path& file) {
    auto picture = media::readHdr(file);
    if (!picture) return picture.error();
    hdr_ = true;
    prepareFor(light::LightQuality::Still, 1);
    const auto began = std::chrono::steady_clock::now();
    analysis_->analyse(picture->radianceLin, found_[0]);
    light_ms_ = millisecondsSince(began);
    if (const std::string repairs = picture->repairs(); !repairs.empty())
        log::warn("{}: {}", file.string(), repairs);
    gpu_[0].setFrame(picture->radianceLin);
    uploadLight(found_[0]);
    if (setup_.analysis.lights) casting_ = lights_.follow(found_[0].lights, 0);
    return Done{};
}

void Environment::prepareFor(light::LightQuality quality, size_t slots) {
    setup_.analysis.quality = quality;
    setup_.analysis.frames = setup_.options.light;
    setup_.analysis.lights =
        setup_.analysis.lights && ((hasDepthTrack() && setup_.drawsDepth) || setup_.roomIsSeen);
    analysis_.emplace(setup_.analysis);
    found_.resize(slots);
    pictures_.resize(slots);
    depths_.resize(slots);
}

// Opens the film's depth track; without one, or with a broken one, no depth is known.
void Environment::openDepth(const Path& film) {
    const Path file = media::depthTrackOf(film);
    std::error_code missing;
    if (!std::filesystem::exists(file, missing)) return;
    if (Status s = media::DepthTrack::open(file, film).moveTo(depthTrack_); !s)
        log::warn("{}; the film is shown without depth", s.error().message());
}

// Refines the depth of a frame; on the decode thread.
void Environment::prepareDepth(const media::VideoFrame& frame, const light::FrameView& leftEye) {
    const int number = depthTrack_->frameAt(frame.time_s);
    if (number != trackFrameNumber_ && depthTrack_->read(number, trackFrame_)) trackFrameNumber_ = number;
    if (trackFrameNumber_ < 0) return;
    Depth& depth = depths_[frame.slot];
    depthRefiner_.refine(trackFrame_, leftEye, depth.map);
    depth::widenNear(depth.map, depth.widened);
    depth.range.make(depth.map);
    depth.light.make(found_[frame.slot].radianceLin, depth.map);
}

// Analyses a frame; on the decode thread.
void Environment::prepare(const media::VideoFrame& frame) {
    const light::FrameView leftEye = leftEyeOf(frame.pixelsBgr, frame.layout, true);
    analysis_->analyse(leftEye, found_[frame.slot]);
    if (depthTrack_ && setup_.drawsDepth) prepareDepth(frame, leftEye);
    found_[frame.slot].cameraResponse.response.chromaTexels = glm::min(frame.chromaTexels, 2);
    media::toBgra(frame.pixelsBgr, true, pictures_[frame.slot]);
}

bool Environment::update(double time_s, bool exact) {
    if (live_) return updateLive(time_s);
    if (!player_) return false;
    const media::VideoFrame* frame = exact ? player_->waitFor(time_s) : player_->newest(time_s);
    if (const std::string status = player_->status(); !status.empty()) {
        log::warn("{}", status);
        notice_ = game::Notice{"The film is damaged here; its last good picture stays"};
    }
    videoPosition_s_ = time_s - static_cast<double>(frame->index - frame->number) / player_->info().fps;
    return show(*frame, time_s);
}

bool Environment::updateLive(double time_s) {
    const media::VideoFrame& frame = *live_->newest();
    if (liveNotice_ != live_->notice()) {
        liveNotice_ = live_->notice();
        liveNotice_.empty() ? log::info("pictures come again") : log::warn("{}", liveNotice_);
        notice_ = noticeOf(live_->state());
    }
    return show(frame, time_s);
}

// Returns false if the frame is shown already.
bool Environment::show(const media::VideoFrame& frame, double time_s) {
    follow(found_[frame.slot], time_s);
    if (frame.index == shownFrame_) return false;
    shownFrame_ = frame.index;
    setLayout(frame.layout);
    const auto began = std::chrono::steady_clock::now();
    uploadPicture(frame.slot);
    upload_ms_ = millisecondsSince(began);
    light_ms_ = static_cast<float>(frame.prepare_ms);
    decode_ms_ = static_cast<float>(frame.decode_ms);
    return true;
}

void Environment::setLayout(media::Layout layout) {
    layout_ = layout;
    twoPictures_ = setup_.bothEyes && layout != media::Layout::Mono;
}

// Runs for every picture and not only new frames: smoother than the video.
void Environment::follow(const FrameFindings& now, double time_s) {
    const AnalysisOptions& wanted = setup_.analysis;
    const auto dt_s = static_cast<float>(time_s - lastUpdate_s_);
    lastUpdate_s_ = time_s;
    if (wanted.water) water_.follow(now.water, setup_.waterIsCertain ? 1 : now.water.evidence, dt_s);
    if (wanted.lights) casting_ = lights_.follow(now.lights, dt_s);
    if (wanted.cameraResponse) {
        cameraResponse_.follow(now.cameraResponse, dt_s);
        cameraResponse_.followGlare(now.glare.maxShare, dt_s);
    }
}

void Environment::uploadPicture(size_t slot) {
    const ImageRgba8& frame = pictures_[slot];
    for (int eye = 0; eye < (twoPictures_ ? 2 : 1); ++eye) {
        const media::EyePart part = media::eyePart(layout_, eye, frame.width, frame.height);
        render::EnvironmentGpu& on = gpu_[static_cast<size_t>(eye)];
        on.setFrame({frame.at(part.x, part.y), part.width, part.height, frame.width});
        if (!depths_[slot].map.inverse.empty())
            on.setDepth(&depths_[slot].map, &depths_[slot].widened, &depths_[slot].range);
    }
    lightDifference_ = gpu_[0].depth() ? &depths_[slot].light : nullptr;
    uploadLight(found_[slot]);
}

void Environment::uploadLight(const FrameFindings& now) {
    for (int eye = 0; eye < (twoPictures_ ? 2 : 1); ++eye) {
        render::EnvironmentGpu& on = gpu_[static_cast<size_t>(eye)];
        on.uploadLight(now.light, now.smooth);
        if (setup_.analysis.cameraResponse && !hdr_) on.uploadScattered(now.glare.spread);
    }
}

glm::mat3 Environment::envFromWorld() const {
    // Positive angles about +Y turn to the left: a direction yaw to the right comes ahead.
    return glm::mat3_cast(glm::angleAxis(yaw_, glm::vec3(0, 1, 0)));
}

render::Exposure Environment::exposure(Tone chosen, float exposure_ev) const {
    using enum render::ToneCurve;
    const auto curve = chosen == Tone::Linear ? Linear : chosen == Tone::Aces || hdr_ ? Aces : InverseOfVideo;
    const bool thesis = setup_.options.light == light::FrameRadiance::Thesis;
    return {curve, exposure_ev, thesis ? render::FrameCoding::Thesis : render::FrameCoding::Srgb};
}

game::Text Environment::lightName() const {
    if (hdr_) return "as measured, GGX prefiltered";
    switch (setup_.options.light) {
    case light::FrameRadiance::Auto:
        break;
    case light::FrameRadiance::Thesis:
        return "thesis inverse tone mapping, GGX prefiltered";
    case light::FrameRadiance::Linear:
        return "decoded sRGB, GGX prefiltered";
    }
    return "decoded sRGB, clipped light estimated, GGX prefiltered";
}

} // namespace shoal::app
