#include "engine/media/VideoSource.h"

#include "engine/media/PictureHeader.h"

#include <opencv2/core.hpp>

extern "C" {
#include <libavutil/display.h>
}

#include <algorithm>
#include <cmath>
#include <thread>

namespace shoal::media {

// Pixels that one thread decodes at least per second, H.264 of a few Mbit/s; each thread needs memory for
// some pictures.
constexpr double kPixelsPerThread = 64e6;
constexpr int kMaxThreads = 8;
constexpr double kMaxStamp = 9e15;   // exact in double
constexpr int kMaxBadPackets = 4096; // in a row, without a picture

// Containers of video. FFmpeg's other formats include playlists and scripts that name further files.
constexpr const char* kContainers = "mov,matroska,avi,ogg,flv,mpeg,mpegts";

static double rateOf(AVRational rate) { return rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0; }

// Returns the clockwise quarter turns that make the stream's pictures upright; phones store them.
static int quarterTurnsOf(const AVStream& stream) {
    const auto* matrix = sideData<int32_t>(stream, AV_PKT_DATA_DISPLAYMATRIX, 9);
    const double turn_deg = matrix ? av_display_rotation_get(matrix) : 0;
    return std::isfinite(turn_deg) ? static_cast<int>(std::lround(-turn_deg / 90)) & 3 : 0;
}

Result<VideoSource> VideoSource::open(const Path& file, Layout request) {
    setUpDecoders();
    const auto begin = readFileBegin(file, 64 << 10);
    if (!begin) return begin.error();
    if (begin->empty()) return Error{file.string(), "is empty"};
    if (const auto picture = readPictureHeader(*begin)) // a better reason than the decoder's
        return Error{file.string(), std::string("is a ") + nameOf(picture->kind) +
                                        " picture, not a video; give it as " +
                                        (isHdr(picture->kind) ? "--env" : "--photo")};
    VideoSource source;
    source.file_ = file;
    if (const Status opened = source.reopen(); !opened) return Error{file.string(), opened.error().reason};
    source.info_.metadata = sphericalMetadata(*source.in_.input, source.in_.opened(), file);
    source.readInfo();
    if (!source.findLayout(request)) return Error{file.string(), "its first frame cannot be decoded"};
    // A frame may state more than its stream: HEVC has a message that turns BT.2020 to HLG.
    source.held_ = source.held_ || source.decode();
    if (!source.held_) return Error{file.string(), "its first frame cannot be decoded"};
    const FrameColour colour = source.in_.decoder.colour();
    source.info_.matrix = colour.matrix;
    source.info_.transfer = colour.transfer;
    return source;
}

Status VideoSource::reopen() {
    const Error undecodable{"", "has no video that can be decoded: damaged, cut short, only sound, or of a "
                                "codec that is not installed"};
    in_.input.reset();
    position_ = 0;
    begun_ = held_ = in_.drained = false;
    in_.input = openInput(file_, kContainers);
    if (!in_.input)
        return Error{"", "is not a video of a known kind (MP4, MOV, WebM, MKV, AVI, MPEG, OGG, FLV), or is "
                         "damaged at its beginning"};
    // Checked before the decoder sees the stream, if the container states a size.
    for (unsigned i = 0; i < in_.input->nb_streams; ++i)
        if (const AVCodecParameters& stated = *in_.input->streams[i]->codecpar;
            stated.codec_type == AVMEDIA_TYPE_VIDEO && std::max(stated.width, stated.height) > kMaxVideoSide)
            return checkPictureSize(stated.width, stated.height);
    if (avformat_find_stream_info(in_.input.get(), nullptr) < 0) return undecodable;
    in_.stream = av_find_best_stream(in_.input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (in_.stream < 0) return undecodable;
    keepOnly(*in_.input, in_.stream);
    const AVCodecParameters& coded = *in_.opened().codecpar;
    if (Status playable = checkPictureSize(coded.width, coded.height); !playable) return playable;
    const double pixelRate = 1.0 * coded.width * coded.height * rateOf(in_.opened().avg_frame_rate);
    const auto cores = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 64u));
    const int threads = static_cast<int>(
        std::clamp(std::ceil(pixelRate / kPixelsPerThread), 1.0, 1.0 * std::min(cores, kMaxThreads)));
    if (!in_.decoder.open(in_.opened(), FrameThreading::ByThreads, threads)) return undecodable;
    return Done{};
}

void VideoSource::readInfo() {
    const AVStream& stream = in_.opened();
    const AVCodecParameters& coded = *stream.codecpar;
    quarterTurns_ = quarterTurnsOf(stream);
    info_.width = quarterTurns_ % 2 ? coded.height : coded.width;
    info_.height = quarterTurns_ % 2 ? coded.width : coded.height;
    rate_ = rateOf(stream.avg_frame_rate);
    if (rate_ == 0) rate_ = rateOf(stream.r_frame_rate);
    info_.fps = rate_ >= kMinFps && rate_ <= kMaxFps ? rate_ : kFallbackFps;
    const double count =
        stream.nb_frames > 0 ? static_cast<double>(stream.nb_frames) : std::round(in_.length_s() * rate_);
    info_.frameCount = count > 1 && count < 1e8 ? static_cast<int64_t>(count) : 0;
    // An edit list may show fewer frames than are stored.
    const double shown_s = static_cast<double>(stream.duration) * av_q2d(stream.time_base);
    const double shown = std::round(shown_s * info_.fps);
    if (shown >= 1 && shown < static_cast<double>(info_.frameCount))
        info_.frameCount = static_cast<int64_t>(shown);
    info_.duration_s = static_cast<double>(info_.frameCount) / info_.fps;
    info_.codec = avcodec_get_name(coded.codec_id);
}

bool VideoSource::decode() {
    if (!in_.next(kMaxBadPackets)) return false;
    if (!begun_ && position_ == 0) {
        begins_ = in_.decoder.frame().best_effort_timestamp;
        begun_ = true;
    }
    return true;
}

bool VideoSource::grab() {
    if (!std::exchange(held_, false) && !decode()) return false;
    ++position_;
    return true;
}

bool VideoSource::retrieve(ImageRgb8& bgr, ImageRgbF* radianceLin) {
    const AVFrame& frame = in_.decoder.frame();
    const bool across = quarterTurns_ % 2;
    if (frame.width != (across ? bgr.height : bgr.width) || frame.height != (across ? bgr.width : bgr.height))
        return false;
    if (quarterTurns_ == 0) return in_.decoder.convert(bgr, radianceLin).ok();
    if (!in_.decoder.convert(unturned_, radianceLin ? &unturnedLin_ : nullptr)) return false;
    const auto turn = [&](auto& unturned, auto& image, int type) {
        image.fit(across ? unturned.height : unturned.width, across ? unturned.width : unturned.height);
        if (image.empty()) return;
        const cv::Mat from(unturned.height, unturned.width, type, unturned.pixels.data());
        cv::Mat to(image.height, image.width, type, image.pixels.data());
        constexpr cv::RotateFlags kTurns[] = {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                              cv::ROTATE_90_COUNTERCLOCKWISE};
        cv::rotate(from, to, kTurns[quarterTurns_ - 1]);
    };
    turn(unturned_, bgr, CV_8UC3);
    if (radianceLin) turn(unturnedLin_, *radianceLin, CV_32FC3);
    return true;
}

// Seeks to the last key frame at or before this frame; starts further back each time that the container's own
// search lands after it.
bool VideoSource::jump(int64_t number) {
    const double frame_stamps = 1 / (rate_ * av_q2d(in_.opened().time_base)); // time stamps a frame
    if (!begun_ || begins_ == AV_NOPTS_VALUE || !std::isfinite(frame_stamps)) return false;
    for (int64_t before = 0;; before = 2 * before + 16) {
        const int64_t aim = std::max(int64_t{0}, number - before);
        const double stamp =
            static_cast<double>(begins_) + std::floor(static_cast<double>(aim) * frame_stamps);
        if (!(std::abs(stamp) < kMaxStamp)) return false;
        if (!in_.seek(static_cast<int64_t>(stamp))) return false;
        if (decode()) {
            const int64_t at = in_.decoder.frame().best_effort_timestamp;
            if (at == AV_NOPTS_VALUE) return false;
            const double found =
                std::round((static_cast<double>(at) - static_cast<double>(begins_)) / frame_stamps);
            if (found >= 0 && found <= static_cast<double>(number)) {
                position_ = static_cast<int64_t>(found);
                held_ = true;
                return true;
            }
        }
        if (aim == 0) return false;
    }
}

bool VideoSource::seek(int64_t number) {
    if (number == position_) return true;
    // Near the stated end a seek could land after the real end, so it stops short and the caller grabs on.
    constexpr int64_t kShortOfEnd = 16;
    const int64_t safe = std::clamp(number, int64_t{0}, std::max(int64_t{0}, info_.frameCount - kShortOfEnd));
    if (number >= position_ && safe <= position_) return true;
    // All other time stamps count from the first frame's.
    if (seekable_ && !begun_ && position_ == 0) held_ = decode();
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
    const Layout shape = layoutFromShape(info_.width, info_.height);
    if (shape == Layout::TopBottom || shape == Layout::LeftRight) return found(shape, "shape");
    // Two eyes' pictures may be squeezed to 2:1. The first frame that tells anything decides, and two more
    // have to agree if it tells of two eyes. A film may begin with a fade.
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
