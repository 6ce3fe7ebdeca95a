#include "tests/unit/live_server/MadeStream.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include <cstring>
#include <memory>
#include <utility>

namespace shoal::media::test {

namespace {

template <auto free> struct Free {
    template <class T> void operator()(T* thing) const { free(&thing); }
};

template <class Byte> int keep(void* pieces, Byte* bytes, int count) { // FFmpeg 7 has them const
    static_cast<std::vector<std::string>*>(pieces)->emplace_back(reinterpret_cast<const char*>(bytes),
                                                                 static_cast<size_t>(count));
    return count;
}

} // namespace

std::optional<MadeStream> makeStream(const std::string& format, const std::string& options,
                                     const std::vector<int>& greys, int width, int height) {
    const AVCodec* kind = avcodec_find_encoder_by_name("libx264");
    if (!kind) return std::nullopt;
    const std::unique_ptr<AVCodecContext, Free<avcodec_free_context>> encoder(avcodec_alloc_context3(kind));
    encoder->width = width;
    encoder->height = height;
    encoder->time_base = {1, 30};
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder->gop_size = 8;
    encoder->thread_count = 1;
    av_opt_set(encoder->priv_data, "preset", "ultrafast", 0);
    av_opt_set(encoder->priv_data, "tune", "zerolatency", 0);
    if (avcodec_open2(encoder.get(), kind, nullptr) < 0) return std::nullopt;

    constexpr int kPiece = 1400; // below a network's largest packet
    std::vector<std::string> pieces;
    AVFormatContext* muxer = nullptr;
    if (avformat_alloc_output_context2(&muxer, nullptr, format.c_str(), "rtp://127.0.0.1:0") < 0)
        return std::nullopt;
    AVIOContext* out = avio_alloc_context(static_cast<uint8_t*>(av_malloc(kPiece)), kPiece, 1, &pieces,
                                          nullptr, keep, nullptr);
    out->max_packet_size = kPiece;
    muxer->pb = out;
    muxer->packet_size = kPiece;
    muxer->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    AVStream* stream = avformat_new_stream(muxer, nullptr);
    avcodec_parameters_from_context(stream->codecpar, encoder.get());
    stream->time_base = encoder->time_base;
    AVDictionary* requests = nullptr;
    av_dict_parse_string(&requests, options.c_str(), "=", ":", 0);
    MadeStream made;
    bool good = avformat_write_header(muxer, &requests) >= 0;
    av_dict_free(&requests);
    char text[2048]{};
    if (good && format == "rtp") av_sdp_create(&muxer, 1, text, sizeof text);
    made.description = text;

    const std::unique_ptr<AVFrame, Free<av_frame_free>> frame(av_frame_alloc());
    const std::unique_ptr<AVPacket, Free<av_packet_free>> packet(av_packet_alloc());
    frame->width = width;
    frame->height = height;
    frame->format = AV_PIX_FMT_YUV420P;
    av_frame_get_buffer(frame.get(), 0);
    for (size_t i = 0; good && i < greys.size(); ++i) {
        av_frame_make_writable(frame.get());
        const int luma = 16 + (219 * greys[i] + 127) / 255;
        std::memset(frame->data[0], luma, static_cast<size_t>(frame->linesize[0]) * height);
        for (const int plane : {1, 2})
            std::memset(frame->data[plane], 128, static_cast<size_t>(frame->linesize[plane]) * (height / 2));
        frame->pts = static_cast<int64_t>(i);
        good = avcodec_send_frame(encoder.get(), frame.get()) >= 0 &&
               avcodec_receive_packet(encoder.get(), packet.get()) >= 0;
        if (!good) break;
        av_packet_rescale_ts(packet.get(), encoder->time_base, stream->time_base);
        good = av_write_frame(muxer, packet.get()) >= 0;
        av_packet_unref(packet.get());
        av_write_frame(muxer, nullptr);
        avio_flush(out);
        made.pieces.push_back(std::exchange(pieces, {}));
    }
    av_write_trailer(muxer);
    av_freep(&out->buffer);
    avio_context_free(&out);
    muxer->pb = nullptr;
    avformat_free_context(muxer);
    if (!good) return std::nullopt;
    return made;
}

} // namespace shoal::media::test
