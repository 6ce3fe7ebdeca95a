#include "content/make/video/Kept.h"

#include "content/make/Output.h"
#include "engine/core/WriteFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace shoal::reef {

namespace {

constexpr float kCodes = 4095;
constexpr std::array<int, 3> kPlaneOf = {2, 0, 1}; // FFmpeg keeps green, blue, red

using media::Codec, media::Frame, media::Input, media::Output, media::Packet;

Codec encoder(int width, int height) {
    const AVCodec* ffv1 = avcodec_find_encoder(AV_CODEC_ID_FFV1);
    Codec codec(avcodec_alloc_context3(ffv1));
    codec->width = width, codec->height = height;
    codec->pix_fmt = AV_PIX_FMT_GBRAP12LE;
    codec->time_base = {1, 24};
    codec->gop_size = 1;
    codec->thread_count = 1;
    codec->level = 3;
    return avcodec_open2(codec.get(), ffv1, nullptr) < 0 ? nullptr : std::move(codec);
}

Frame frameOf(const Drawn& drawn) {
    Frame frame = media::makeFrame();
    frame->format = AV_PIX_FMT_GBRAP12LE;
    frame->width = drawn.radianceLin.width, frame->height = drawn.radianceLin.height;
    frame->pts = 0;
    if (av_frame_get_buffer(frame.get(), 0) < 0) return nullptr;
    for (int plane = 0; plane < 4; ++plane)
        for (int y = 0; y < frame->height; ++y) {
            const int index = plane < 3 ? kPlaneOf[static_cast<size_t>(plane)] : plane;
            auto* to = reinterpret_cast<uint16_t*>(frame->data[index] +
                                                   static_cast<ptrdiff_t>(y) * frame->linesize[index]);
            for (int x = 0; x < frame->width; ++x)
                to[x] = plane < 3 ? codeOfRadiance(drawn.radianceLin.at(x, y)[plane])
                                  : codeOfDistance(drawn.distance[static_cast<size_t>(y) * frame->width + x]);
        }
    return frame;
}

Drawn drawnOf(const AVFrame& frame) {
    Drawn drawn{ImageRgbF(frame.width, frame.height),
                std::vector<float>(static_cast<size_t>(frame.width) * frame.height)};
    std::array<float, 4096> radiances, distances;
    for (size_t i = 0; i < radiances.size(); ++i) {
        radiances[i] = radianceOfCode(static_cast<uint16_t>(i));
        distances[i] = distanceOfCode(static_cast<uint16_t>(i));
    }
    for (int plane = 0; plane < 4; ++plane)
        for (int y = 0; y < frame.height; ++y) {
            const int index = plane < 3 ? kPlaneOf[static_cast<size_t>(plane)] : plane;
            const auto* from = reinterpret_cast<const uint16_t*>(
                frame.data[index] + static_cast<ptrdiff_t>(y) * frame.linesize[index]);
            for (int x = 0; x < frame.width; ++x) {
                const size_t code = from[x] & 4095;
                if (plane < 3)
                    drawn.radianceLin.at(x, y)[plane] = radiances[code];
                else
                    drawn.distance[static_cast<size_t>(y) * frame.width + x] = distances[code];
            }
        }
    return drawn;
}

} // namespace

uint16_t codeOfRadiance(float radiance) {
    static const float scale = kCodes / std::log2(1 + kKeptBrightest / kKeptDark);
    const float x = std::clamp(radiance, 0.0f, kKeptBrightest);
    return static_cast<uint16_t>(scale * std::log2(1 + x / kKeptDark) + 0.5f);
}

float radianceOfCode(uint16_t code) {
    static const float scale = std::log2(1 + kKeptBrightest / kKeptDark) / kCodes;
    return kKeptDark * (std::exp2(static_cast<float>(code) * scale) - 1);
}

uint16_t codeOfDistance(float metres) {
    static const float scale = kCodes / std::log2(kKeptFurthest / kKeptNearest);
    const float x = std::clamp(metres, kKeptNearest, kKeptFurthest);
    return static_cast<uint16_t>(scale * std::log2(x / kKeptNearest) + 0.5f);
}

float distanceOfCode(uint16_t code) {
    static const float scale = std::log2(kKeptFurthest / kKeptNearest) / kCodes;
    return kKeptNearest * std::exp2(static_cast<float>(code) * scale);
}

Status keep(const Drawn& drawn, const Path& file) {
    const Error failed{file.string(), "could not be written"};
    const Codec codec = encoder(drawn.radianceLin.width, drawn.radianceLin.height);
    const Frame frame = frameOf(drawn);
    const Packet packet = media::makePacket();
    if (!codec || !frame || avcodec_send_frame(codec.get(), frame.get()) < 0 ||
        avcodec_receive_packet(codec.get(), packet.get()) < 0)
        return failed;
    AVFormatContext* made = nullptr;
    if (avformat_alloc_output_context2(&made, nullptr, "nut", nullptr) < 0) return failed;
    const Output output(made);
    AVStream* stream = avformat_new_stream(made, nullptr);
    stream->time_base = codec->time_base;
    made->flags |= AVFMT_FLAG_BITEXACT;
    if (avcodec_parameters_from_context(stream->codecpar, codec.get()) < 0 ||
        avio_open_dyn_buf(&made->pb) < 0 || avformat_write_header(made, nullptr) < 0 ||
        av_write_frame(made, packet.get()) < 0 || av_write_trailer(made) < 0)
        return failed;
    uint8_t* bytes = nullptr;
    const int size = avio_close_dyn_buf(std::exchange(made->pb, nullptr), &bytes);
    const std::unique_ptr<uint8_t, decltype(&av_free)> held(bytes, av_free);
    return writeFileWhole(file, {reinterpret_cast<const char*>(bytes), static_cast<size_t>(size)});
}

Result<Drawn> recall(const Path& file, int width) {
    const Error failed{file.string(), "is no traced frame; remove it"};
    const Input input = media::openInput(file, "nut");
    const Packet packet = media::makePacket();
    if (!input || input->nb_streams != 1 || av_read_frame(input.get(), packet.get()) < 0) return failed;
    const AVCodecParameters* about = input->streams[0]->codecpar;
    if (about->width != width || about->height != width / 2)
        return Error{file.string(), "was traced at another size; remove it"};
    const AVCodec* ffv1 = avcodec_find_decoder(AV_CODEC_ID_FFV1);
    const Codec codec(avcodec_alloc_context3(ffv1));
    const Frame frame = media::makeFrame();
    if (avcodec_parameters_to_context(codec.get(), about) < 0 ||
        avcodec_open2(codec.get(), ffv1, nullptr) < 0 || avcodec_send_packet(codec.get(), packet.get()) < 0 ||
        avcodec_receive_frame(codec.get(), frame.get()) < 0 || frame->format != AV_PIX_FMT_GBRAP12LE)
        return failed;
    return drawnOf(*frame);
}

} // namespace shoal::reef
