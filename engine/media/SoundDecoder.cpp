#include "engine/media/SoundDecoder.h"

#include "engine/media/Quiet.h"
#include "engine/media/SoundTrack.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/channel_layout.h>
#include <libswresample/swresample.h>
}

#include <array>
#include <cmath>
#include <cstdlib>

namespace shoal::media {

namespace {

constexpr int kMostChannels = 64, kMostRate_Hz = 384000;
constexpr int kMostFrame = 1 << 16; // samples of one decoded block
constexpr int kMostBadPackets = 64; // in a row; a few are passed over
constexpr int64_t kHole =
    kSoundRate_Hz / 50; // a time stamp that far off is believed; nearer ones are rounding

} // namespace

struct SoundDecoder::Impl {
    AVFormatContext* file = nullptr;
    AVCodecContext* codec = nullptr;
    SwrContext* converter = nullptr; // from the form that follows
    AVChannelLayout from{};
    int rate_Hz = 0, format = AV_SAMPLE_FMT_NONE;
    AVPacket* packet = av_packet_alloc();
    AVFrame* block = av_frame_alloc();
    int stream = -1;
    double begins_s = 0;  // the first picture's time stamp
    int64_t follows = -1; // the frame that the next samples should begin with; -1: as the time stamp says
    bool draining = false;

    ~Impl() {
        swr_free(&converter);
        av_channel_layout_uninit(&from);
        av_frame_free(&block);
        av_packet_free(&packet);
        avcodec_free_context(&codec);
        avformat_close_input(&file);
    }

    Status open(const Path& path) {
        const auto failed = [&](const char* reason) { return Error{path.string(), reason}; };
        std::error_code code;
        if (!std::filesystem::is_regular_file(path, code)) return failed("there is no such file");
        // As a file and nothing else: neither a name nor a playlist may lead to a server.
        const std::string name = "file:" + path.string();
        AVDictionary* options = nullptr;
        av_dict_set(&options, "protocol_whitelist", "file", 0);
        const int opened = avformat_open_input(&file, name.c_str(), nullptr, &options);
        av_dict_free(&options);
        if (opened < 0 || avformat_find_stream_info(file, nullptr) < 0)
            return failed("is not a file with sound that can be read");
        const AVCodec* kind = nullptr;
        stream = av_find_best_stream(file, AVMEDIA_TYPE_AUDIO, -1, -1, &kind, 0);
        if (stream < 0 || !kind) return failed("has no sound");
        for (unsigned i = 0; i < file->nb_streams; ++i)
            file->streams[i]->discard = static_cast<int>(i) == stream ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
        const int picture = av_find_best_stream(file, AVMEDIA_TYPE_VIDEO, -1, stream, nullptr, 0);
        const AVStream& first = *file->streams[picture >= 0 ? picture : stream];
        if (first.start_time != AV_NOPTS_VALUE)
            begins_s = static_cast<double>(first.start_time) * av_q2d(first.time_base);
        codec = avcodec_alloc_context3(kind);
        if (!codec || avcodec_parameters_to_context(codec, file->streams[stream]->codecpar) < 0)
            return failed("has a sound that cannot be decoded");
        codec->pkt_timebase = file->streams[stream]->time_base;
        codec->thread_count = 1; // there is little to do
        if (avcodec_open2(codec, kind, nullptr) < 0) return failed("has a sound that cannot be decoded");
        return Done{};
    }

    // For the form of this block; a stream may change it on the way.
    bool prepareConverter() {
        if (block->sample_rate < 1000 || block->sample_rate > kMostRate_Hz || block->nb_samples < 1 ||
            block->nb_samples > kMostFrame || block->ch_layout.nb_channels < 1 ||
            block->ch_layout.nb_channels > kMostChannels)
            return false;
        // A decoder may only know how many channels there are.
        AVChannelLayout layout{};
        if (block->ch_layout.order == AV_CHANNEL_ORDER_UNSPEC)
            av_channel_layout_default(&layout, block->ch_layout.nb_channels);
        else if (av_channel_layout_copy(&layout, &block->ch_layout) < 0)
            return false;
        const bool same = converter && rate_Hz == block->sample_rate && format == block->format &&
                          av_channel_layout_compare(&from, &layout) == 0;
        av_channel_layout_uninit(&from);
        from = layout; // its owner now
        if (same) return true;
        rate_Hz = block->sample_rate;
        format = block->format;
        swr_free(&converter);
        AVChannelLayout stereo = AV_CHANNEL_LAYOUT_STEREO;
        if (swr_alloc_set_opts2(&converter, &stereo, AV_SAMPLE_FMT_S16, kSoundRate_Hz, &from,
                                static_cast<AVSampleFormat>(format), rate_Hz, 0, nullptr) >= 0 &&
            swr_init(converter) >= 0)
            return true;
        swr_free(&converter);
        return false;
    }

    // The decoded block as samples; their first frame, or -1 if it is nonsense.
    int64_t convert(std::vector<int16_t>& stereo) {
        if (!prepareConverter()) return -1;
        int64_t begins = follows;
        if (block->best_effort_timestamp != AV_NOPTS_VALUE) {
            const double seconds =
                static_cast<double>(block->best_effort_timestamp) * av_q2d(codec->pkt_timebase) - begins_s;
            if (!(std::abs(seconds) < 1e7)) return -1;
            // What still waits in the converter comes out first.
            const int64_t stated =
                std::llround(seconds * kSoundRate_Hz) - swr_get_delay(converter, kSoundRate_Hz);
            if (follows < 0 || std::llabs(stated - follows) > kHole) begins = stated;
        }
        const int most = swr_get_out_samples(converter, block->nb_samples);
        if (most < 0 || most > kMostFrame * 64) return -1;
        stereo.resize(static_cast<size_t>(most) * 2);
        auto* out = reinterpret_cast<uint8_t*>(stereo.data());
        const int got = swr_convert(converter, &out, most, const_cast<const uint8_t**>(block->extended_data),
                                    block->nb_samples);
        if (got < 0) return -1;
        stereo.resize(static_cast<size_t>(got) * 2);
        if (begins < 0 && follows < 0 && block->best_effort_timestamp == AV_NOPTS_VALUE) begins = 0;
        follows = begins + got;
        return begins;
    }

    int64_t next(std::vector<int16_t>& stereo) {
        stereo.clear();
        for (int bad = 0; bad < kMostBadPackets;) {
            const int got = avcodec_receive_frame(codec, block);
            if (got == 0) {
                const int64_t begins = convert(stereo);
                // Before the first picture there is nothing to be heard: the priming of a codec, mostly.
                const auto count = static_cast<int64_t>(stereo.size() / 2);
                if (begins + count > 0 && count > 0) {
                    if (begins >= 0) return begins;
                    stereo.erase(stereo.begin(), stereo.begin() + static_cast<ptrdiff_t>(-begins) * 2);
                    return 0;
                }
                stereo.clear();
                ++bad;
                continue;
            }
            if (got == AVERROR_EOF || draining) return -1;
            if (got != AVERROR(EAGAIN)) {
                ++bad;
            }
            const int read = av_read_frame(file, packet);
            if (read < 0) {
                draining = true;
                avcodec_send_packet(codec, nullptr);
                continue;
            }
            if (packet->stream_index == stream && avcodec_send_packet(codec, packet) < 0) ++bad;
            av_packet_unref(packet);
        }
        return -1;
    }
};

Result<SoundDecoder> SoundDecoder::open(const Path& file) {
    setUpDecoders();
    auto impl = std::make_unique<Impl>();
    if (Status opened = impl->open(file); !opened) return opened.error();
    return SoundDecoder(std::move(impl));
}

SoundDecoder::SoundDecoder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SoundDecoder::SoundDecoder(SoundDecoder&&) noexcept = default;
SoundDecoder& SoundDecoder::operator=(SoundDecoder&&) noexcept = default;
SoundDecoder::~SoundDecoder() = default;

double SoundDecoder::length_s() const {
    return impl_->file->duration > 0 ? static_cast<double>(impl_->file->duration) / AV_TIME_BASE : 0;
}

bool SoundDecoder::seek(int64_t frame) {
    Impl& d = *impl_;
    const AVStream& stream = *d.file->streams[d.stream];
    const double seconds = static_cast<double>(frame) / kSoundRate_Hz + d.begins_s;
    const auto stamp = static_cast<int64_t>(std::floor(seconds / av_q2d(stream.time_base)));
    if (av_seek_frame(d.file, d.stream, stamp, AVSEEK_FLAG_BACKWARD) < 0 &&
        (frame > 0 || av_seek_frame(d.file, d.stream, 0, AVSEEK_FLAG_BACKWARD | AVSEEK_FLAG_ANY) < 0))
        return false;
    avcodec_flush_buffers(d.codec);
    swr_free(&d.converter);
    d.follows = -1;
    d.draining = false;
    return true;
}

int64_t SoundDecoder::next(std::vector<int16_t>& stereo) { return impl_->next(stereo); }

} // namespace shoal::media
