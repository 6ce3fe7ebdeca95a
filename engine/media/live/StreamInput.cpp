#include "engine/media/live/StreamInput.h"

#include "engine/media/DecoderSetup.h"
#include "engine/media/PictureDecoder.h"

extern "C" {
#include <libavutil/time.h>
}

#include <cstdio>

namespace shoal::media {

namespace {

// Containers of video; no play lists, which name further addresses.
constexpr const char* kFormats =
    "mpegts,mov,mp4,matroska,webm,avi,flv,live_flv,ogg,mpeg,mpjpeg,mjpeg,h264,hevc,ivf,nut,rtsp,sdp,rtp";

std::string textOf(int error) {
    char text[AV_ERROR_MAX_STRING_SIZE]{};
    av_strerror(error, text, sizeof text);
    return text;
}

std::string seconds(double s) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g s", s);
    return text;
}

} // namespace

StreamInput::StreamInput(const LiveAddress& address, const FeedTimeouts& timeouts)
    : address_(address), timeouts_(timeouts) {
    setUpDecoders();
    if (const auto* pipe = std::get_if<PipeAddress>(&address_))
        pipe_.emplace(pipe->file, [this] { return givesUp(); });
}

StreamInput::~StreamInput() = default;

bool StreamInput::givesUp() const { return interrupted_ || stopped_ || liveNow_s() > deadline_s_; }

// Leaves format_ with its streams known.
Status StreamInput::openFormat() {
    AVFormatContext* format = avformat_alloc_context();
    if (!format) return Error{"", "cannot be opened: there is no memory"};
    format->interrupt_callback = {
        [](void* self) -> int { return static_cast<StreamInput*>(self)->givesUp(); }, this};
    const auto* url = std::get_if<StreamAddress>(&address_);
    std::string name;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "format_whitelist", kFormats, 0);
    if (url) {
        name = url->url;
        av_dict_set(&options, "protocol_whitelist", url->protocols, 0);
        av_dict_set(&options, "user_agent", "Shoal", 0);
        av_dict_set(&options, "rtsp_flags", "prefer_tcp", 0);
    } else {
        av_dict_set(&options, "protocol_whitelist", "none", 0);
        format->pb = pipe_->context();
        format->flags |= AVFMT_FLAG_CUSTOM_IO;
    }
    format->max_analyze_duration = AV_TIME_BASE;
    format->fps_probe_size = 0; // frames come when they come: no need to wait for several
    int error =
        avformat_open_input(&format, name.c_str(), nullptr, &options); // frees the context if it fails
    av_dict_free(&options);
    format_.reset(format);
    if (error >= 0) {
        passPacketsUnparsed();
        error = avformat_find_stream_info(format, nullptr);
    }
    if (error >= 0) return Done{};
    format_.reset();
    if (!interrupted_ && liveNow_s() > deadline_s_)
        return Error{"", "did not answer within " + seconds(timeouts_.open_s)};
    if (error == AVERROR_INVALIDDATA || error == AVERROR(EIO) || error == AVERROR_EOF)
        return Error{"", "is no video of a known kind, or breaks off before its first picture"};
    return Error{"", "cannot be opened: " + textOf(error)};
}

Status StreamInput::open() {
    format_.reset();
    stream_ = -1;
    stopped_ = false;
    deadline_s_ = liveNow_s() + timeouts_.open_s;
    if (pipe_)
        if (Status opened = pipe_->open(); !opened) return opened;
    if (Status opened = openFormat(); !opened) return opened;
    stream_ = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream_ < 0) return Error{"", "has no pictures"};
    keepOnly(*format_, stream_);
    const AVCodecParameters& coded = *video().codecpar;
    if (coded.width > 0)
        if (Status playable = checkPictureSize(coded.width, coded.height); !playable) return playable;
    parser_.reset(unparsed_ ? av_parser_init(coded.codec_id) : nullptr);
    parsed_.reset(avcodec_alloc_context3(nullptr));
    if (parser_ && parsed_ && avcodec_parameters_to_context(parsed_.get(), &coded) >= 0)
        parser_->flags |= PARSER_FLAG_COMPLETE_FRAMES;
    else
        parser_.reset();
    stored_ = !pipe_ && format_->pb && avio_size(format_->pb) > 0;
    stamped_ = !(format_->iformat->flags & AVFMT_NOTIMESTAMPS);
    return Done{};
}

// FFmpeg's parser finds the end of a picture by the beginning of the next, which would delay each by one. In
// these formats packets are pictures already; a parser of our own tells which are key frames.
void StreamInput::passPacketsUnparsed() {
    const std::string_view name = format_->iformat->name;
    unparsed_ = name == "mpegts" || name == "rtsp";
    if (unparsed_) format_->flags |= AVFMT_FLAG_NOPARSE | AVFMT_FLAG_NOFILLIN;
}

void StreamInput::markKeyFrame(AVPacket& packet) {
    uint8_t* bytes = nullptr;
    int size = 0;
    av_parser_parse2(parser_.get(), parsed_.get(), &bytes, &size, packet.data, packet.size, packet.pts,
                     packet.dts, packet.pos);
    const bool key =
        parser_->key_frame == 1 || (parser_->key_frame < 0 && parser_->pict_type == AV_PICTURE_TYPE_I);
    packet.flags = key ? packet.flags | AV_PKT_FLAG_KEY : packet.flags & ~AV_PKT_FLAG_KEY;
}

const AVStream& StreamInput::video() const { return *format_->streams[stream_]; }

Status StreamInput::read(AVPacket& packet) {
    deadline_s_ = liveNow_s() + timeouts_.silence_s;
    for (;;) {
        av_packet_unref(&packet);
        const int error = av_read_frame(format_.get(), &packet);
        if (error >= 0 && packet.stream_index == stream_) {
            if (parser_) markKeyFrame(packet);
            return Done{};
        }
        if (givesUp() || error == AVERROR_EXIT)
            return Error{"", "has sent no picture for " + seconds(timeouts_.silence_s)};
        if (error == AVERROR_EOF) return Error{"", stored_ ? "is over" : "was ended by its sender"};
        if (error == AVERROR(EAGAIN))
            av_usleep(5000);
        else if (error < 0)
            return Error{"", "broke off: " + textOf(error)};
    }
}

} // namespace shoal::media
