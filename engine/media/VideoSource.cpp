#include "engine/media/VideoSource.h"

#include "engine/core/Log.h"
#include "engine/core/Number.h"
#include "engine/math/Quantile.h"
#include "engine/media/Check.h"

#include <fmt/core.h>

#include <thread>

namespace shoal::media {

// Pixels that one thread decodes at least per second, H.264 of a few Mbit/s; each thread needs memory for
// some pictures.
constexpr double kPixelsPerThread = 64e6;
constexpr int kMaxThreads = 16;
constexpr double kMaxStamp = 9e15;        // exact in double
constexpr int kMaxBadPackets = 4096;      // in a row, without a picture
constexpr double kLongestPicture_s = 600; // beyond the stated length, a longer step of the stamps is an error

constexpr double kLate = 0.25; // share of a frame by which a picture may come late
// Within this many frames of the stated end, nothing is sought or left out: the real end may come earlier.
constexpr int64_t kShortOfEnd = 16;
constexpr double kKeyFrames_s = 5; // distance of key frames that are not known

static double rateOf(AVRational rate) { return rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0; }

// Returns the rate of the stream's pictures where they are densest, at the beginning of the file; 0: unknown.
// Matroska states a rate whatever its stamps are.
static double densestRate(const Path& file, int stream) {
    constexpr size_t kPictures = 300;
    constexpr int64_t kBytes = 16 << 20;
    const Input input = openInput(file, kVideoContainers);
    if (!input || stream >= static_cast<int>(input->nb_streams)) return 0;
    keepOnly(*input, stream);
    const double unit_s = av_q2d(input->streams[stream]->time_base);
    const Packet packet = makePacket();
    std::vector<double> times_s, gaps_s;
    for (int64_t bytes = 0; times_s.size() < kPictures && bytes < kBytes; av_packet_unref(packet.get())) {
        if (av_read_frame(input.get(), packet.get()) < 0) break;
        const int64_t stamp = packet->pts == AV_NOPTS_VALUE ? packet->dts : packet->pts;
        bytes += packet->size;
        if (packet->stream_index == stream && stamp != AV_NOPTS_VALUE)
            times_s.push_back(static_cast<double>(stamp) * unit_s);
    }
    std::ranges::sort(times_s);
    for (size_t i = 1; i < times_s.size(); ++i)
        if (times_s[i] > times_s[i - 1]) gaps_s.push_back(times_s[i] - times_s[i - 1]);
    if (gaps_s.empty()) return 0;
    // A tenth may be shorter by mistake. The mean of those about as long evens out the rounding of stamps.
    const double limit_s = 1.25 * math::quantile(gaps_s, 0.1);
    double sum_s = 0, count = 0;
    for (const double gap_s : gaps_s)
        if (gap_s <= limit_s) sum_s += gap_s, ++count;
    return count / sum_s;
}

// Returns the length of the stream's pictures as the file states it, seconds; 0: it does not.
static double statedLength(const FileDecoder& in) {
    const AVStream& stream = in.opened();
    if (stream.duration > 0) return static_cast<double>(stream.duration) * av_q2d(stream.time_base);
    const AVDictionaryEntry* tag = av_dict_get(stream.metadata, "DURATION", nullptr, 0); // of Matroska
    int64_t microseconds = 0;
    constexpr int kIsDuration = 1;
    const bool read = tag && av_parse_time(&microseconds, tag->value, kIsDuration) >= 0 && microseconds > 0;
    return read ? static_cast<double>(microseconds) * 1e-6 : in.length_s();
}

Result<VideoSource> VideoSource::open(const Path& file, Layout request, Decoding decoding) {
    setUpDecoders();
    const auto kind = mediaKind(file); // a better reason than the decoder's
    if (!kind) return kind.error();
    if (*kind == MediaKind::DepthTrack)
        return Error{file.string(), "is the depth of a film; give the film beside it"};
    if (*kind == MediaKind::Photo || *kind == MediaKind::Hdr)
        return Error{file.string(), std::string("is a picture, not a video; give it as ") +
                                        (*kind == MediaKind::Hdr ? "--env" : "--photo")};
    VideoSource source;
    source.file_ = file;
    source.decoding_ = decoding;
    if (const Status opened = source.reopen(); !opened) return Error{file.string(), opened.error().reason};
    SphericalMetadata& stated = source.info_.metadata;
    stated = sphericalMetadata(*source.in_.input, source.in_.opened(), file);
    if (stated.projection > Projection::Equirect)
        return Error{file.string(), fmt::format("is {}; only lat-long video can be shown, so convert it",
                                                enumName(stated.projection))};
    source.readInfo();
    const Status coloured = source.readColour();
    if (!coloured) return Error{file.string(), coloured.error().reason};
    if (!source.findLayout(request)) return Error{file.string(), "its first frame cannot be decoded"};
    source.findPlace();
    return source;
}

Status VideoSource::reopen() {
    position_ = 0;
    begun_ = hasAhead_ = isShowing_ = false;
    if (Status opened = in_.openFilm(file_); !opened) return opened;
    const AVCodecParameters& coded = *in_.opened().codecpar;
    const double pixelRate = 1.0 * coded.width * coded.height * rateOf(in_.opened().avg_frame_rate);
    const bool isSparing = decoding_ == Decoding::Sparing;
    const double needed = isSparing ? std::min(pixelRate / kPixelsPerThread, 8.0) : kMaxThreads;
    const int threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1,
                                   std::max(static_cast<int>(std::ceil(needed)), 1));
    return in_.decoder.open(in_.opened(), FrameThreading::ByThreads, threads, kMaxVideoPixels,
                            decoding_ == Decoding::Card);
}

void VideoSource::readInfo() {
    const AVStream& stream = in_.opened();
    const AVCodecParameters& coded = *stream.codecpar;
    const bool across = swapsSides(info_.metadata.orientation);
    storedWidth_ = coded.width, storedHeight_ = coded.height;
    info_.width = across ? coded.height : coded.width;
    info_.height = across ? coded.width : coded.height;
    constexpr double kMaxAspect = 16;
    const double aspect =
        rateOf(av_guess_sample_aspect_ratio(in_.input.get(), in_.input->streams[in_.stream], nullptr));
    if (isWithin(aspect, 1 / kMaxAspect, kMaxAspect)) pixelAspect_ = across ? 1 / aspect : aspect;
    const bool interlaced = coded.field_order > AV_FIELD_PROGRESSIVE; // its fields may have stamps
    const double mean = rateOf(stream.avg_frame_rate),
                 densest = interlaced ? 0 : densestRate(file_, in_.stream);
    double rate = mean > 0 && (mean <= kMaxFps || densest == 0) ? mean : densest;
    if (densest > 1.05 * rate) rate = densest; // less is jitter
    if (rate == 0) rate = rateOf(stream.r_frame_rate);
    if (rate == 0) rate = kFallbackFps;
    info_.storedFps = std::max(mean > 0 ? mean : rate, 1 / kLongestPicture_s);
    info_.fps = std::clamp(rate, kMinFps, kMaxFps);
    length_s_ = statedLength(in_);
    const bool counted = stream.nb_frames > 0 && info_.fps == mean;
    const double shown = std::round(length_s_ * info_.fps);
    double count = counted ? static_cast<double>(stream.nb_frames) : shown;
    if (shown >= 1) count = std::min(count, shown); // an edit list may show fewer frames than are stored
    info_.frameCount = count > 1 && count < 1e8 ? static_cast<int64_t>(count) : 0;
    info_.duration_s = static_cast<double>(info_.frameCount) / info_.fps;
    info_.codec = avcodec_get_name(coded.codec_id);
}

// Reads the colours of the first frame, which may state more than its stream: HEVC has a message that turns
// BT.2020 to HLG. Fails if it cannot be decoded.
Status VideoSource::readColour() {
    decodeAhead();
    if (!hasAhead_) return Error{"", "its first frame cannot be decoded"};
    const FrameColour colour = in_.decoder.colour(*ahead_);
    info_.matrix = colour.matrix;
    info_.transfer = colour.transfer;
    return colour.decodable;
}

// Finds the size of frames that are placed in their bounds, before memory is taken for them.
void VideoSource::findPlace() {
    SphericalMetadata& stated = info_.metadata;
    if (stated.bounds.isWhole()) return;
    const EyePart eye = eyePart(info_.layout, 0, info_.width, info_.height);
    const auto fullWidth = static_cast<int>(std::lround(eye.width / stated.bounds.width())),
               fullHeight = static_cast<int>(std::lround(eye.height / stated.bounds.height()));
    const int width = info_.width / eye.width * fullWidth, height = info_.height / eye.height * fullHeight;
    isPlaced_ = std::max(fullWidth, fullHeight) <= kMaxVideoSide &&
                int64_t{width} * height <= int64_t{kMaxVideoSide} * kMaxVideoSide;
    stated.boundsIgnored = !isPlaced_;
    if (isPlaced_)
        info_.width = width, info_.height = height;
    else
        stated.bounds = {};
}

// Decodes the picture after the one shown.
void VideoSource::decodeAhead() {
    in_.decoder.exchange(ahead_);
    hasAhead_ = in_.next(kMaxBadPackets);
    in_.decoder.exchange(ahead_);
    if (in_.decoder.cardFailed()) return leaveCard();
    if (!hasAhead_) return;
    if (!std::exchange(begun_, true)) begins_ = ahead_->best_effort_timestamp;
    ahead_s_ = timeOfAhead();
}

void VideoSource::leaveCard() {
    log::info("{}: decoded without a graphics card from here on", file_.string());
    const int64_t position = position_;
    decoding_ = Decoding::AllThreads;
    if (!reopen()) return;
    if (position == 0) return decodeAhead();
    seek(position - 1);
    while (position_ < position && grab()) {
    }
}

double VideoSource::timeOfAhead() const {
    const int64_t stamp = ahead_->best_effort_timestamp;
    const double follows_s = isShowing_ ? shown_s_ + 1 / info_.storedFps : 0;
    if (stamp == AV_NOPTS_VALUE || begins_ == AV_NOPTS_VALUE) return follows_s;
    const double time_s =
        (static_cast<double>(stamp) - static_cast<double>(begins_)) * av_q2d(in_.opened().time_base);
    const double latest_s = std::max(length_s_, shown_s_ + kLongestPicture_s);
    return !isShowing_ || (time_s > shown_s_ && time_s <= latest_s) ? time_s : follows_s;
}

void VideoSource::showAhead() {
    in_.decoder.exchange(ahead_);
    isShowing_ = true;
    shown_s_ = ahead_s_;
    const double lasts_s =
        static_cast<double>(durationOf(in_.decoder.frame())) * av_q2d(in_.opened().time_base);
    end_s_ = shown_s_ + (lasts_s > 0 && lasts_s <= kLongestPicture_s ? lasts_s : 1 / info_.storedFps);
    decodeAhead();
}

bool VideoSource::grab(bool hurries) {
    in_.hurries = hurries && position_ + kShortOfEnd + kMaxThreads < info_.frameCount;
    const double due_s = (static_cast<double>(position_) + kLate) / info_.fps;
    if (!isShowing_ && !hasAhead_) decodeAhead();
    while (hasAhead_ && (!isShowing_ || ahead_s_ <= due_s)) showAhead();
    if (!isShowing_ || (!hasAhead_ && due_s >= end_s_)) return false;
    ++position_;
    return true;
}

bool VideoSource::retrieve(ImageRgb8& bgr, ImageRgbF* radianceLin) {
    const AVFrame& frame = in_.decoder.frame();
    if (frame.width != storedWidth_ || frame.height != storedHeight_) return false;
    constexpr int kMaxLightSide = 1024; // of light that is placed, as of other light
    const int side = std::max(info_.width, info_.height);
    const auto place = [&](auto& stored, auto& upright, auto& whole, int wholeSide) {
        if (info_.metadata.orientation != 1)
            makeUpright(stored, info_.metadata.orientation, isPlaced_ ? upright : whole);
        if (!isPlaced_) return;
        whole.fit(std::max(info_.width * wholeSide / side, 2), std::max(info_.height * wholeSide / side, 2));
        placeInSphere(info_.metadata.orientation != 1 ? upright : stored, info_.layout, info_.metadata.bounds,
                      whole);
    };
    if (info_.metadata.orientation == 1 && !isPlaced_) return in_.decoder.convert(bgr, radianceLin).ok();
    if (!in_.decoder.convert(stored_, radianceLin ? &storedLin_ : nullptr)) return false;
    place(stored_, upright_, bgr, side);
    if (!radianceLin) return true;
    if (storedLin_.empty())
        *radianceLin = {};
    else
        place(storedLin_, uprightLin_, *radianceLin, std::min(side, kMaxLightSide));
    return true;
}

double VideoSource::stampOf(double number) const {
    return static_cast<double>(begins_) + std::floor(number / info_.fps / av_q2d(in_.opened().time_base));
}

int64_t VideoSource::keyFrameBefore(int64_t number) const {
    if (!seekable_ || !begun_ || begins_ == AV_NOPTS_VALUE) return 0;
    AVStream* stream = in_.input->streams[in_.stream];
    // The index may hold times of decoding, `delay` frames before those of showing, so an earlier time is
    // looked up. The key frame found is certain if the index has a later entry too.
    const int64_t delay = 2 * stream->codecpar->video_delay;
    const double stamp = stampOf(static_cast<double>(number - delay) + kLate);
    const auto at = static_cast<int64_t>(std::clamp(stamp, -kMaxStamp, kMaxStamp));
    const AVIndexEntry* key = avformat_index_get_entry_from_timestamp(stream, at, AVSEEK_FLAG_BACKWARD);
    const double frames =
        (key ? static_cast<double>(key->timestamp - begins_) : 0) * av_q2d(stream->time_base) * info_.fps;
    const bool isCertain = avformat_index_get_entry_from_timestamp(stream, at, AVSEEK_FLAG_ANY);
    const int64_t usual = isCertain ? 0 : number - static_cast<int64_t>(kKeyFrames_s * info_.fps);
    return std::clamp(std::max(std::lround(frames) + delay, usual), int64_t{0}, number);
}

// Seeks to the last key frame at or before this frame, from further back when the search lands after it.
bool VideoSource::jump(int64_t number) {
    if (!begun_ || begins_ == AV_NOPTS_VALUE || !(av_q2d(in_.opened().time_base) > 0)) return false;
    for (int64_t before = 0;; before = 2 * before + 16) {
        const int64_t aim = std::max(int64_t{0}, number - before);
        const double stamp = stampOf(static_cast<double>(aim) + kLate);
        if (!(std::abs(stamp) < kMaxStamp) || !in_.seek(static_cast<int64_t>(stamp))) return false;
        isShowing_ = false;
        decodeAhead();
        if (hasAhead_) {
            if (ahead_->best_effort_timestamp == AV_NOPTS_VALUE) return false;
            const double found = std::ceil(ahead_s_ * info_.fps - kLate);
            if (found <= static_cast<double>(number) && ahead_s_ > -1 / info_.fps) {
                position_ = static_cast<int64_t>(std::max(found, 0.0));
                return true;
            }
        }
        if (aim == 0) return false;
    }
}

bool VideoSource::seek(int64_t number) {
    if (number == position_) return true;
    // Near the end it seeks to an earlier frame; the caller grabs the frames from there on.
    const int64_t safe = std::clamp(number, int64_t{0}, std::max(int64_t{0}, info_.frameCount - kShortOfEnd));
    if (number >= position_ && safe <= position_) return true;
    // All other time stamps count from the first frame's.
    if (seekable_ && !begun_) decodeAhead();
    if (seekable_ && jump(safe)) return true;
    if (!seekable_ && number >= position_) return true;
    seekable_ = false; // from now on this file is only read in order
    return reopen().ok();
}

bool VideoSource::findLayout(Layout request) {
    const auto found = [this](Layout layout, const char* source) {
        info_.layout = layout;
        info_.layoutSource = source;
        return layout != Layout::Auto;
    };
    if (found(request, "asked for") || found(info_.metadata.layout, "metadata")) return true;
    const SphereBounds& bounds = info_.metadata.bounds;
    const Layout shape =
        layoutFromShape(info_.width * pixelAspect_ / bounds.width(), info_.height / bounds.height());
    // Two eyes' pictures may be squeezed to 2:1, and square films are as often ordinary ones. The first frame
    // that tells anything (a film may fade in) decides, and two more have to agree if it tells of two eyes.
    constexpr int64_t kFrames = 6;
    Layout content = Layout::Auto;
    ImageRgb8 frame(info_.width, info_.height);
    for (int64_t i = 0, told = 0; i < kFrames && told < 3 && content != Layout::Mono; ++i) {
        const bool read = seek(info_.frameCount * i / kFrames) && grab() && retrieve(frame);
        if (!read && i == 0 && shape == Layout::Auto) return false;
        if (!read) break; // if the file ends earlier than stated, the frames before decide
        const Layout one = layoutFromContent(frame);
        if (one == Layout::Auto) continue;
        content = ++told == 1 || one == content ? one : Layout::Mono;
    }
    if (content == Layout::Auto) content = Layout::Mono;
    return seek(0) && found(content, content == shape ? "shape" : "content");
}

} // namespace shoal::media
