#include "engine/media/live/StreamInput.h"

#include "engine/media/Quiet.h"
#include "engine/media/VideoInfo.h"

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/time.h>
}

#include <cstdio>

namespace shoal::media {

namespace {

// No play lists, which name further addresses; nothing that is no video.
constexpr const char* kFormats =
    "mpegts,mov,mp4,matroska,webm,avi,flv,live_flv,ogg,mpeg,mpjpeg,mjpeg,h264,hevc,ivf,nut,rtsp,sdp,rtp";

std::string words(int error) {
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

StreamInput::StreamInput(const LiveAddress& address, const FeedPatience& patience)
    : address_(address), patience_(patience) {
    setUpDecoders();
    if (const auto* pipe = std::get_if<PipeAddress>(&address_))
        pipe_.emplace(pipe->file, [this] { return givesUp(); });
}

StreamInput::~StreamInput() { close(); }

void StreamInput::close() {
    avformat_close_input(&format_);
    stream_ = -1;
}

bool StreamInput::givesUp() const { return interrupted_ || left_ || liveNow_s() > until_s_; }

Status StreamInput::open() {
    close();
    left_ = false;
    until_s_ = liveNow_s() + patience_.open_s;
    format_ = avformat_alloc_context();
    if (!format_) return Error{"", "cannot be opened: there is no memory"};
    format_->interrupt_callback = {
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
        if (Status opened = pipe_->open(); !opened) return av_dict_free(&options), opened.error();
        format_->pb = pipe_->context();
        format_->flags |= AVFMT_FLAG_CUSTOM_IO;
    }
    format_->max_analyze_duration = AV_TIME_BASE;
    format_->fps_probe_size = 0; // pictures come when they come: no need to look at many before the first
    int error =
        avformat_open_input(&format_, name.c_str(), nullptr, &options); // frees the context if it fails
    av_dict_free(&options);
    if (error >= 0) {
        giveWholePictures();
        error = avformat_find_stream_info(format_, nullptr);
    }
    if (error < 0) {
        close();
        if (!interrupted_ && liveNow_s() > until_s_)
            return Error{"", "did not answer within " + seconds(patience_.open_s)};
        if (error == AVERROR_INVALIDDATA || error == AVERROR(EIO) || error == AVERROR_EOF)
            return Error{"", "is no video of a known kind, or breaks off before its first picture"};
        return Error{"", "cannot be opened: " + words(error)};
    }
    stream_ = av_find_best_stream(format_, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream_ < 0) return Error{"", "has no pictures"};
    for (unsigned i = 0; i < format_->nb_streams; ++i)
        if (static_cast<int>(i) != stream_) format_->streams[i]->discard = AVDISCARD_ALL;
    const AVCodecParameters& coded = *picture().codecpar;
    if (coded.width > kMaxVideoSide || coded.height > kMaxVideoSide)
        return Error{"",
                     "its picture is larger than the limit of " + std::to_string(kMaxVideoSide) + " a side"};
    parser_.reset(whole_ ? av_parser_init(coded.codec_id) : nullptr);
    parsed_.reset(avcodec_alloc_context3(nullptr));
    if (parser_ && parsed_ && avcodec_parameters_to_context(parsed_.get(), &coded) >= 0)
        parser_->flags |= PARSER_FLAG_COMPLETE_FRAMES;
    else
        parser_.reset();
    stored_ = url && format_->pb && avio_size(format_->pb) > 0;
    stamped_ = !(format_->iformat->flags & AVFMT_NOTIMESTAMPS);
    return Done{};
}

// FFmpeg's own parser tells a picture's end by the next one's beginning: it would hold each back by one. In
// these formats packets are pictures already; whether they are key pictures a parser of ours tells.
void StreamInput::giveWholePictures() {
    const std::string_view name = format_->iformat->name;
    whole_ = name == "mpegts" || name == "rtsp";
    if (whole_) format_->flags |= AVFMT_FLAG_NOPARSE | AVFMT_FLAG_NOFILLIN;
}

void StreamInput::tellKey(AVPacket& packet) {
    uint8_t* bytes = nullptr;
    int size = 0;
    av_parser_parse2(parser_.get(), parsed_.get(), &bytes, &size, packet.data, packet.size, packet.pts,
                     packet.dts, packet.pos);
    const bool key =
        parser_->key_frame == 1 || (parser_->key_frame < 0 && parser_->pict_type == AV_PICTURE_TYPE_I);
    packet.flags = key ? packet.flags | AV_PKT_FLAG_KEY : packet.flags & ~AV_PKT_FLAG_KEY;
}

const AVStream& StreamInput::picture() const { return *format_->streams[stream_]; }

Status StreamInput::read(AVPacket& packet) {
    until_s_ = liveNow_s() + patience_.silence_s;
    for (;;) {
        av_packet_unref(&packet);
        const int error = av_read_frame(format_, &packet);
        if (error >= 0 && packet.stream_index == stream_) {
            if (parser_) tellKey(packet);
            return Done{};
        }
        if (givesUp() || error == AVERROR_EXIT)
            return Error{"", "has sent no picture for " + seconds(patience_.silence_s)};
        if (error == AVERROR_EOF) return Error{"", stored_ ? "is over" : "was ended by its sender"};
        if (error == AVERROR(EAGAIN))
            av_usleep(5000);
        else if (error < 0)
            return Error{"", "broke off: " + words(error)};
    }
}

} // namespace shoal::media
