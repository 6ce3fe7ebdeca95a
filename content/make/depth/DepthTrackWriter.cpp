#include "content/make/depth/DepthTrackWriter.h"

#include "content/make/Output.h"
#include "engine/core/WriteFile.h"

#include <fmt/core.h>

extern "C" {
#include <libavutil/opt.h>
}

#include <algorithm>
#include <utility>

namespace shoal::media {

static constexpr uint16_t kUnusedCode = 512; // value of plane Cr

uint16_t depthCode(float inverse_perM, int stepsPerOctave) {
    const float share = inverse_perM > 0 ? std::min(inverse_perM / kMaxInverse_perM, 1.0f) : 0;
    const int code = static_cast<int>(share * kMaxDepthCode + 0.5f);
    int step = 1;
    while (code / step >= 2 * stepsPerOctave) step *= 2;
    return static_cast<uint16_t>(std::min((code + step / 2) / step * step, kMaxDepthCode));
}

struct DepthTrackWriter::Impl {
    DepthTrackInfo info;
    Output output;
    Codec codec;
    Frame frame = makeFrame();
    Packet packet = makePacket();
    int next = 0;
};

Result<DepthTrackWriter> DepthTrackWriter::make(const DepthTrackInfo& info,
                                                std::span<const std::string> films) {
    const Error failed{"", "FFmpeg's FFV1 encoder is not to be had"};
    if (!isDepthTrack(info)) return Error{"", "no depth track has this size"};
    setUpDecoders();
    auto impl = makeHidden<Impl>();
    impl->info = info;
    const AVCodec* ffv1 = avcodec_find_encoder(AV_CODEC_ID_FFV1);
    impl->codec.reset(avcodec_alloc_context3(ffv1));
    AVCodecContext& codec = *impl->codec;
    codec.width = info.width, codec.height = info.height;
    codec.pix_fmt = kDepthPixels;
    codec.time_base = av_d2q(info.duration_s / info.frameCount, 1'000'000);
    codec.gop_size = 1;                      // every frame by itself
    if (info.width <= 352) codec.slices = 1; // each slice starts its statistics anew
    codec.thread_count = 1;
    codec.level = 3;
    codec.flags |= AV_CODEC_FLAG_BITEXACT;
    av_opt_set_int(codec.priv_data, "slicecrc", 1, 0);
    if (avcodec_open2(&codec, ffv1, nullptr) < 0) return failed;
    AVFormatContext* made = nullptr;
    if (avformat_alloc_output_context2(&made, nullptr, "matroska", nullptr) < 0) return failed;
    impl->output.reset(made);
    AVStream* stream = avformat_new_stream(made, nullptr);
    stream->time_base = codec.time_base;
    stream->avg_frame_rate = av_inv_q(codec.time_base);
    made->flags |= AVFMT_FLAG_BITEXACT;
    std::string identities;
    for (const std::string& film : films) identities += (identities.empty() ? "" : " ") + film;
    const auto tag = [&](const char* name, const std::string& value) {
        av_dict_set(&made->metadata, name, value.c_str(), 0);
    };
    tag(depth_tags::kVersion, depth_tags::kVersionValue);
    tag(depth_tags::kFrames, std::to_string(info.frameCount));
    tag(depth_tags::kDuration, fmt::format("{}", info.duration_s));
    tag(depth_tags::kLayout, depth_tags::kLayoutValue);
    tag(depth_tags::kFilms, identities);
    if (avcodec_parameters_from_context(stream->codecpar, &codec) < 0 || avio_open_dyn_buf(&made->pb) < 0 ||
        avformat_write_header(made, nullptr) < 0)
        return failed;
    impl->frame->format = kDepthPixels;
    impl->frame->width = info.width, impl->frame->height = info.height;
    if (av_frame_get_buffer(impl->frame.get(), 0) < 0) return failed;
    return DepthTrackWriter(std::move(impl));
}

Status DepthTrackWriter::add(const DepthFrame& depth) {
    Impl& track = *impl_;
    const Error failed{"", "a frame of depth could not be encoded"};
    AVFrame& frame = *track.frame;
    const size_t texels = static_cast<size_t>(frame.width) * static_cast<size_t>(frame.height);
    if (depth.width != frame.width || depth.height != frame.height || depth.inverse.size() != texels ||
        depth.confidence.size() != texels / 4)
        return failed;
    if (av_frame_make_writable(&frame) < 0) return failed;
    const auto plane = [&](int index, int width, int height, const auto& codeOf) {
        for (int y = 0; y < height; ++y) {
            auto* row = reinterpret_cast<uint16_t*>(frame.data[index] +
                                                    static_cast<ptrdiff_t>(y) * frame.linesize[index]);
            for (int x = 0; x < width; ++x) row[x] = codeOf(static_cast<size_t>(y) * width + x);
        }
    };
    plane(0, frame.width, frame.height, [&](size_t i) { return depth.inverse[i]; });
    plane(1, frame.width / 2, frame.height / 2, [&](size_t i) { return depth.confidence[i]; });
    plane(2, frame.width / 2, frame.height / 2, [](size_t) { return kUnusedCode; });
    frame.pts = track.next++;
    if (avcodec_send_frame(track.codec.get(), &frame) < 0 ||
        avcodec_receive_packet(track.codec.get(), track.packet.get()) < 0)
        return failed;
    AVPacket& packet = *track.packet;
    av_packet_rescale_ts(&packet, track.codec->time_base, track.output->streams[0]->time_base);
    packet.duration = 0;
    packet.flags |= AV_PKT_FLAG_KEY;
    if (av_write_frame(track.output.get(), &packet) < 0) return failed;
    return Done{};
}

Status DepthTrackWriter::finish(const Path& file) {
    Impl& track = *impl_;
    if (track.next != track.info.frameCount)
        return Error{file.string(), "is not written: some frames are missing"};
    if (av_write_trailer(track.output.get()) < 0) return Error{file.string(), "could not be written"};
    uint8_t* bytes = nullptr;
    const int size = avio_close_dyn_buf(std::exchange(track.output->pb, nullptr), &bytes);
    const std::unique_ptr<uint8_t, decltype(&av_free)> held(bytes, av_free);
    return writeFileWhole(file, {reinterpret_cast<const char*>(bytes), static_cast<size_t>(size)});
}

} // namespace shoal::media
