#include "engine/media/SoundTrack.h"

#include "engine/core/Log.h"
#include "engine/core/ThreadPool.h"
#include "engine/media/Decoder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <numbers>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace shoal::media {

namespace {

// Bounds of a pass's length: in a shorter pass the thread would only seek.
constexpr double kShortest_s = 0.1, kLongest_s = 24 * 3600;
constexpr int kMaxChannels = 64, kMinRate_Hz = 1000, kMaxRate_Hz = 384000;
constexpr int kMaxBlock = 1 << 16; // samples of one decoded block
constexpr int kMaxBadPackets = 64; // in a row; fewer are skipped
// A time stamp is believed if it differs from the expected frame by more than this; less is rounding.
constexpr int64_t kHole = kSoundRate_Hz / 50;
constexpr int64_t kEnd = INT64_MAX; // in place of a frame

// Decoder of a file's sound stream: samples at kSoundRate_Hz with their place in time.
class SoundDecoder {
  public:
    static Result<SoundDecoder> open(const Path& file) {
        setUpDecoders();
        const auto failed = [&](const char* reason) { return Error{file.string(), reason}; };
        std::error_code code;
        if (!std::filesystem::is_regular_file(file, code)) return failed("there is no such file");
        SoundDecoder d;
        d.in_.input = openInput(file);
        AVFormatContext* input = d.in_.input.get();
        std::vector<AVChannelLayout> stated; // by the container; decoders of AAC know no ambisonics
        for (unsigned i = 0; input && i < input->nb_streams; ++i)
            stated.push_back(input->streams[i]->codecpar->ch_layout);
        if (!input || avformat_find_stream_info(input, nullptr) < 0)
            return failed("is not a file with sound that can be read");
        const AVCodec* kind = nullptr;
        d.in_.stream = av_find_best_stream(input, AVMEDIA_TYPE_AUDIO, -1, -1, &kind, 0);
        if (d.in_.stream < 0 || !kind) return failed("has no sound");
        keepOnly(*input, d.in_.stream);
        const auto number = static_cast<size_t>(d.in_.stream);
        const AVChannelLayout& decoded = d.in_.opened().codecpar->ch_layout;
        for (const AVChannelLayout& layout : {number < stated.size() ? stated[number] : decoded, decoded})
            if (layout.order == AV_CHANNEL_ORDER_AMBISONIC && layout.nb_channels == decoded.nb_channels &&
                layout.nb_channels - std::popcount(layout.u.mask) >= 4) // the mask is of further channels
                d.field_ = layout;
        d.name_ = file.string();
        const int picture = filmStreamOf(*input);
        const AVStream& first = *input->streams[picture >= 0 ? picture : d.in_.stream];
        if (first.start_time != AV_NOPTS_VALUE)
            d.begins_s_ = static_cast<double>(first.start_time) * av_q2d(first.time_base);
        if (!d.in_.decoder.open(d.in_.opened(), FrameThreading::ByThreads, 1)) // there is little work
            return failed("has a sound that cannot be decoded");
        return d;
    }

    double length_s() const { return in_.length_s(); }
    int channels() const { return field_ ? 4 : 2; }

    // Seeks to this frame or somewhat before it; returns false if the file cannot be read there.
    bool seek(int64_t frame) {
        const double seconds = static_cast<double>(frame) / kSoundRate_Hz + begins_s_;
        const auto stamp = static_cast<int64_t>(std::floor(seconds / av_q2d(in_.opened().time_base)));
        if (!in_.seek(stamp) && (frame > 0 || !in_.seek(0, AVSEEK_FLAG_BACKWARD | AVSEEK_FLAG_ANY)))
            return false;
        swr_close(converter_.get());
        follows_ = -1;
        return true;
    }

    // Replaces samples by the next ones and returns the frame of the first; none, and kEnd, at the end or
    // if nothing more can be decoded. At most some tenths of a second at a time.
    int64_t next(std::vector<int16_t>& samples) {
        for (int bad = 0; bad < kMaxBadPackets && in_.next(kMaxBadPackets); ++bad) {
            const int64_t first = convert(samples);
            if (!samples.empty()) return first;
        }
        samples.clear();
        return kEnd;
    }

  private:
    SoundDecoder() = default;

    // Converts the decoded block to samples and returns the frame of the first; none if the block is invalid,
    // or ends before the first picture.
    int64_t convert(std::vector<int16_t>& samples) {
        samples.clear();
        AVFrame& block = in_.decoder.frame();
        if (block.sample_rate < kMinRate_Hz || block.sample_rate > kMaxRate_Hz || block.nb_samples < 1 ||
            block.nb_samples > kMaxBlock || block.ch_layout.nb_channels < 1 ||
            block.ch_layout.nb_channels > kMaxChannels)
            return -1;
        const int count = block.ch_layout.nb_channels;
        if (const bool isField = field_ && count == field_->nb_channels;
            isField || block.ch_layout.order == AV_CHANNEL_ORDER_UNSPEC ||
            block.ch_layout.order == AV_CHANNEL_ORDER_AMBISONIC) { // of order 0, which is mono
            av_channel_layout_uninit(&block.ch_layout);
            isField ? void(block.ch_layout = *field_) : av_channel_layout_default(&block.ch_layout, count);
        }
        int64_t begins = std::max<int64_t>(follows_, 0);
        if (block.best_effort_timestamp != AV_NOPTS_VALUE) {
            const double seconds =
                static_cast<double>(block.best_effort_timestamp) * av_q2d(in_.opened().time_base) - begins_s_;
            if (!(std::abs(seconds) < 1e7)) return -1;
            // Samples that wait in the converter come out first.
            const int64_t waiting =
                swr_is_initialized(converter_.get()) ? swr_get_delay(converter_.get(), kSoundRate_Hz) : 0;
            const int64_t stated = std::llround(seconds * kSoundRate_Hz) - waiting;
            begins = follows_ < 0 || std::llabs(stated - follows_) > kHole ? stated : follows_;
        }
        AVFrame& out = *converted_;
        av_frame_unref(&out);
        out.format = AV_SAMPLE_FMT_S16;
        out.sample_rate = kSoundRate_Hz;
        av_channel_layout_default(&out.ch_layout, 2);
        if (field_) out.ch_layout = *field_;
        int error = swr_convert_frame(converter_.get(), &out, &block);
        if (error == AVERROR_INPUT_CHANGED) { // a stream may change its format on the way
            swr_close(converter_.get());
            error = swr_convert_frame(converter_.get(), &out, &block);
        }
        if (error < 0) {
            if (!std::exchange(warned_, true))
                log::warn("{}: some of its sound cannot be converted, and is silent", name_);
            return -1;
        }
        follows_ = begins + out.nb_samples;
        // Sound before the first picture is dropped: mostly the priming of a codec.
        const int64_t early = std::clamp<int64_t>(-begins, 0, out.nb_samples);
        const auto* from = reinterpret_cast<const int16_t*>(out.data[0]);
        const ptrdiff_t stride = out.ch_layout.nb_channels;
        const auto* end = from + stride * out.nb_samples;
        for (from += stride * early; from < end; from += stride)
            if (field_) { // stored as W, Y, Z, X (ACN); FuMa's W is weaker than SN3D's
                const long w = std::lround(from[0] / std::numbers::sqrt2);
                samples.insert(samples.end(), {static_cast<int16_t>(w), from[3], from[1], from[2]});
            } else {
                samples.insert(samples.end(), from, from + 2);
            }
        return begins + early;
    }

    FileDecoder in_;
    std::unique_ptr<SwrContext, FreeAt<swr_free>> converter_{swr_alloc()}; // configured by the first block
    Frame converted_ = makeFrame();
    std::optional<AVChannelLayout> field_; // of ambisonics of the first order or more; owns no memory
    std::string name_;
    bool warned_ = false;
    double begins_s_ = 0;  // the first picture's time stamp
    int64_t follows_ = -1; // frame that the next samples should begin with; -1: unknown
};

} // namespace

struct SoundTrack::Impl {
    std::mutex mutex;
    std::condition_variable_any changed;
    // Guarded by mutex:
    std::deque<int16_t> ready;     // interleaved; at most kSoundAhead frames
    std::optional<int64_t> wanted; // frame from which the thread is to go on; empty: where it is
    bool broken = false;

    int64_t pass = 0; // length in frames; constant

    SoundDecoder decoder; // used by the thread only
    const int channels;
    std::jthread thread; // last: it uses all of the above

    explicit Impl(SoundDecoder opened) : decoder(std::move(opened)), channels(decoder.channels()) {}

    // Appends frames (null: silence) as room becomes free. Returns false if stopped or sought meanwhile.
    bool put(const std::stop_token& ending, const int16_t* from, int64_t frames) {
        std::unique_lock lock(mutex);
        while (!ending.stop_requested() && !wanted) {
            const auto room = kSoundAhead - static_cast<int64_t>(ready.size()) / channels;
            const auto samples = static_cast<ptrdiff_t>(channels * std::min(frames, room));
            if (from)
                ready.insert(ready.end(), from, from + samples), from += samples;
            else
                ready.insert(ready.end(), static_cast<size_t>(samples), int16_t{0});
            frames -= samples / channels;
            if (frames == 0) return true;
            changed.wait(lock, ending,
                         [&] { return wanted || std::ssize(ready) < ptrdiff_t{channels} * kSoundAhead; });
        }
        return false;
    }

    // Decodes from this frame on, looping, until stopped or sought.
    void decode(const std::stop_token& ending, int64_t at) {
        std::vector<int16_t> samples;
        while (decoder.seek(at)) {
            while (at < pass) {
                const int64_t first = decoder.next(samples);
                const auto frames = static_cast<int64_t>(samples.size()) / channels;
                const int64_t hole = std::clamp<int64_t>(first - at, 0, pass - at);
                const int64_t past = std::clamp<int64_t>(at - first, 0, frames); // before `at`
                if (!put(ending, nullptr, hole)) return;
                at += hole;
                const int64_t some = std::min(frames - past, pass - at);
                if (!put(ending, samples.data() + channels * past, some)) return;
                at += some;
            }
            at = 0;
        }
        const std::lock_guard lock(mutex);
        broken = true;
    }

    void run(const std::stop_token& ending) {
        lowerThreadPriority();
        std::unique_lock lock(mutex);
        while (changed.wait(lock, ending, [&] { return wanted && !broken; })) {
            const int64_t at = *std::exchange(wanted, std::nullopt) % pass;
            lock.unlock();
            decode(ending, at);
            lock.lock();
        }
    }
};

Result<SoundTrack> SoundTrack::open(const Path& file, double passLength_s) {
    auto decoder = SoundDecoder::open(file);
    if (!decoder) return decoder.error();
    auto impl = makeHidden<Impl>(std::move(*decoder));
    if (!(passLength_s > 0)) passLength_s = impl->decoder.length_s();
    if (!(passLength_s > 0)) passLength_s = kLongest_s;
    impl->pass = std::llround(std::clamp(passLength_s, kShortest_s, kLongest_s) * kSoundRate_Hz);
    impl->thread = std::jthread([raw = impl.get()](const std::stop_token& ending) { raw->run(ending); });
    return SoundTrack(std::move(impl));
}

int64_t SoundTrack::passLength() const { return impl_->pass; }
int SoundTrack::channels() const { return impl_->channels; }

void SoundTrack::seek(int64_t frame) {
    const std::lock_guard lock(impl_->mutex);
    impl_->wanted = std::max<int64_t>(frame, 0);
    impl_->ready.clear();
    impl_->changed.notify_all();
}

size_t SoundTrack::read(std::span<int16_t> samples) {
    const std::lock_guard lock(impl_->mutex);
    std::deque<int16_t>& ready = impl_->ready;
    const auto channels = static_cast<size_t>(impl_->channels);
    const size_t count = std::min(samples.size() / channels * channels, ready.size());
    const auto end = ready.begin() + static_cast<ptrdiff_t>(count);
    const auto rest = std::copy(ready.begin(), end, samples.begin());
    ready.erase(ready.begin(), end);
    impl_->changed.notify_all();
    if (!impl_->broken) return count / channels;
    std::fill(rest, samples.end(), int16_t{0});
    return samples.size() / channels;
}

} // namespace shoal::media
