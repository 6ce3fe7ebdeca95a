#include "engine/media/DepthTrack.h"

#include "engine/core/Hash.h"
#include "engine/core/Number.h"
#include "engine/core/WriteFile.h"
#include "engine/media/Ffmpeg.h"

#include <fmt/core.h>

extern "C" {
#include <libavutil/crc.h>
#include <libavutil/opt.h>
}

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace shoal::media {

namespace {

// Y is the inverse distance, Cb the confidence; Cr is kUnusedCode throughout.
constexpr AVPixelFormat kPixels = AV_PIX_FMT_YUV420P10LE;
constexpr uint16_t kUnusedCode = 512;
constexpr int kMinWidth = 16, kMaxWidth = 4096;
constexpr double kMaxFps = 240; // stamps are milliseconds: frames need stamps of their own
constexpr double kMaxDuration_s = 1e6;
constexpr size_t kIdentityBytes = 1 << 20;

constexpr const char* kVersionTag = "SHOAL_DEPTH";
constexpr const char* kVersion = "1";
constexpr const char* kFramesTag = "SHOAL_FRAMES";
constexpr const char* kDurationTag = "SHOAL_DURATION"; // seconds, of the film
constexpr const char* kLayoutTag = "SHOAL_LAYOUT";
constexpr const char* kLayout = "equirectangular mono";
constexpr const char* kFilmsTag = "SHOAL_FILMS"; // identities, with blanks between

// Powers of two, so that maps of distances hold each texel a whole number of times.
bool isTrack(const DepthTrackInfo& info) {
    const bool fits = info.width >= kMinWidth && info.width <= kMaxWidth && info.height == info.width / 2;
    return fits && std::has_single_bit(static_cast<unsigned>(info.width)) && info.frameCount > 0 &&
           info.duration_s > 0 && info.duration_s <= kMaxDuration_s &&
           info.frameCount <= std::max(info.duration_s * kMaxFps, 1.0);
}

std::string tagOf(const AVFormatContext& input, const char* name) {
    const AVDictionaryEntry* tag = av_dict_get(input.metadata, name, nullptr, 0);
    return tag ? tag->value : "";
}

// Each of FFV1's slices ends with the CRC of what comes before, so that its own is 0, and with it that of all
// (RFC 9043, 4.9.3). FFmpeg's decoder shows damaged slices as they were in the frame before.
bool isWhole(const AVPacket& packet) {
    const AVCRC* table = av_crc_get_table(AV_CRC_32_IEEE);
    return packet.size > 0 && av_crc(table, 0, packet.data, static_cast<size_t>(packet.size)) == 0;
}

} // namespace

uint16_t depthCode(float inverse_perM, int stepsPerOctave) {
    const float share = inverse_perM > 0 ? std::min(inverse_perM / kMaxInverse_perM, 1.0f) : 0;
    const int code = static_cast<int>(share * kMaxDepthCode + 0.5f);
    int step = 1;
    while (code / step >= 2 * stepsPerOctave) step *= 2;
    return static_cast<uint16_t>(std::min((code + step / 2) / step * step, kMaxDepthCode));
}

Path depthTrackOf(const Path& film) {
    Path stem = film;
    stem.replace_extension();
    if (stem.extension() == ".small") stem.replace_extension();
    return Path(stem.string() + ".depth.mkv");
}

Result<std::string> filmIdentity(const Path& film) {
    const auto begin = readFileBegin(film, kIdentityBytes);
    if (!begin) return begin.error();
    Hash hash;
    hash.bytes(begin->data(), begin->size());
    return fmt::format("{:016x}", hash.value());
}

struct DepthTrack::Impl {
    DepthTrackInfo info;
    Input input;
    Codec codec;
    Packet packet = makePacket();
    Frame frame = makeFrame();
    int next = 0; // number of the packet that is read next, where nothing is sought

    bool seek(int number);
    bool readPacket(int number);
    int numberOf(const AVPacket& packet) const;
};

int DepthTrack::Impl::numberOf(const AVPacket& from) const {
    if (from.pts == AV_NOPTS_VALUE) return -1;
    const double time_s = static_cast<double>(from.pts) * av_q2d(input->streams[0]->time_base);
    const double number = std::round(time_s * info.frameCount / info.duration_s);
    return number >= 0 && number < info.frameCount ? static_cast<int>(number) : -1;
}

bool DepthTrack::Impl::seek(int number) {
    const double time_s = number * info.duration_s / info.frameCount;
    const auto stamp = static_cast<int64_t>(time_s / av_q2d(input->streams[0]->time_base));
    return av_seek_frame(input.get(), 0, stamp, AVSEEK_FLAG_BACKWARD) >= 0;
}

bool DepthTrack::Impl::readPacket(int number) {
    constexpr int kReadOn = 32; // packets; a seek costs more
    if ((number < next || number > next + kReadOn) && !seek(number)) return false;
    next = -1 - kReadOn; // until it is found
    for (;;) {
        av_packet_unref(packet.get());
        if (av_read_frame(input.get(), packet.get()) < 0) return false;
        const int found = numberOf(*packet);
        if (found > number) return false;
        if (found < number) continue;
        next = number + 1;
        return true;
    }
}

Result<DepthTrack> DepthTrack::open(const Path& file, const Path& film) {
    setUpDecoders();
    const auto failed = [&](const char* reason) { return Error{file.string(), reason}; };
    if (const auto begin = readFileBegin(file, 16); !begin) return begin.error();
    auto impl = makeHidden<Impl>();
    impl->input = openInput(file, av_find_input_format("matroska"));
    if (!impl->input || tagOf(*impl->input, kVersionTag).empty()) return failed("is no depth track");
    const AVFormatContext& input = *impl->input;
    if (tagOf(input, kVersionTag) != kVersion || tagOf(input, kLayoutTag) != kLayout)
        return failed("is a depth track of another version");
    if (!film.empty()) {
        const auto identity = filmIdentity(film);
        if (!identity) return identity.error();
        if (tagOf(input, kFilmsTag).find(*identity) == std::string::npos)
            return failed("is the depth of another film");
    }
    DepthTrackInfo& info = impl->info;
    info.frameCount = parseNumber<int>(tagOf(input, kFramesTag)).value_or(0);
    info.duration_s = parseNumber<double>(tagOf(input, kDurationTag)).value_or(0);
    if (input.nb_streams != 1) return failed("is damaged: it holds more than one stream");
    const AVCodecParameters& coded = *input.streams[0]->codecpar;
    info.width = coded.width, info.height = coded.height;
    if (coded.codec_id != AV_CODEC_ID_FFV1 || !isTrack(info))
        return failed("is damaged: its header makes no sense");
    const AVCodec* decoder = avcodec_find_decoder(coded.codec_id);
    impl->codec.reset(avcodec_alloc_context3(decoder));
    if (avcodec_parameters_to_context(impl->codec.get(), &coded) < 0) return failed("cannot be decoded");
    impl->codec->thread_count = 1;
    impl->codec->err_recognition = AV_EF_EXPLODE;
    if (avcodec_open2(impl->codec.get(), decoder, nullptr) < 0) return failed("cannot be decoded");
    if (!impl->readPacket(info.frameCount - 1)) return failed("is cut short");
    return DepthTrack(std::move(impl));
}

const DepthTrackInfo& DepthTrack::info() const { return impl_->info; }

int DepthTrack::frameAt(double time_s) const {
    const DepthTrackInfo& info = impl_->info;
    const double turns = time_s / info.duration_s;
    const double share = turns - std::floor(turns);
    return static_cast<int>(std::floor(share * info.frameCount + 0.5)) % info.frameCount;
}

bool DepthTrack::read(int number, DepthFrame& out) {
    Impl& track = *impl_;
    if (number < 0 || number >= track.info.frameCount || !track.readPacket(number)) return false;
    AVFrame& frame = *track.frame;
    if (!isWhole(*track.packet)) return false;
    avcodec_flush_buffers(track.codec.get());
    if (avcodec_send_packet(track.codec.get(), track.packet.get()) < 0 ||
        avcodec_receive_frame(track.codec.get(), &frame) < 0 || frame.format != kPixels ||
        frame.width != track.info.width || frame.height != track.info.height)
        return false;
    out.width = frame.width, out.height = frame.height;
    const auto plane = [&](int index, int width, int height, std::vector<uint16_t>& codes) {
        codes.resize(static_cast<size_t>(width) * height);
        for (int y = 0; y < height; ++y) {
            const auto* row = reinterpret_cast<const uint16_t*>(
                frame.data[index] + static_cast<ptrdiff_t>(y) * frame.linesize[index]);
            std::transform(row, row + width, codes.begin() + static_cast<ptrdiff_t>(y) * width,
                           [](uint16_t code) { return std::min<uint16_t>(code, kMaxDepthCode); });
        }
    };
    plane(0, frame.width, frame.height, out.inverse);
    plane(1, frame.width / 2, frame.height / 2, out.confidence);
    return true;
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
    if (!isTrack(info)) return Error{"", "no depth track has this size"};
    setUpDecoders();
    auto impl = makeHidden<Impl>();
    impl->info = info;
    const AVCodec* ffv1 = avcodec_find_encoder(AV_CODEC_ID_FFV1);
    impl->codec.reset(avcodec_alloc_context3(ffv1));
    AVCodecContext& codec = *impl->codec;
    codec.width = info.width, codec.height = info.height;
    codec.pix_fmt = kPixels;
    codec.time_base = av_d2q(info.duration_s / info.frameCount, 1'000'000);
    codec.gop_size = 1;                      // every frame by itself
    if (info.width <= 352) codec.slices = 1; // each learns statistics anew; FFmpeg cuts larger frames
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
    tag(kVersionTag, kVersion);
    tag(kFramesTag, std::to_string(info.frameCount));
    tag(kDurationTag, fmt::format("{}", info.duration_s));
    tag(kLayoutTag, kLayout);
    tag(kFilmsTag, identities);
    if (avcodec_parameters_from_context(stream->codecpar, &codec) < 0 || avio_open_dyn_buf(&made->pb) < 0 ||
        avformat_write_header(made, nullptr) < 0)
        return failed;
    impl->frame->format = kPixels;
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
