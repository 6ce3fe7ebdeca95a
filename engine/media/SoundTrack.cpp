#include "engine/media/SoundTrack.h"

#include "engine/core/Threads.h"
#include "engine/media/SoundDecoder.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace shoal::media {

namespace {

// Bounds of a pass: shorter ones would only seek.
constexpr double kShortest_s = 0.1, kLongest_s = 24 * 3600;

} // namespace

struct SoundTrack::Impl {
    std::mutex mutex;
    std::condition_variable changed;
    // Guarded by mutex:
    std::vector<int16_t> ring = std::vector<int16_t>(2 * static_cast<size_t>(kSoundAhead));
    size_t begins = 0, count = 0; // frames in it
    int64_t wanted = 0;           // where the thread continues once the generation changes
    int generation = 0;
    bool broken = false;
    bool stop = false;

    int64_t pass = 0; // length in frames; constant

    SoundDecoder decoder; // the thread's
    std::thread thread;

    explicit Impl(SoundDecoder opened) : decoder(std::move(opened)) {}
    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            stop = true;
        }
        changed.notify_all();
        if (thread.joinable()) thread.join();
    }

    // Writes frames (null: silence) to the ring as there is room. False if stopped or sought meanwhile.
    bool put(const int16_t* stereo, int64_t frames, int mine) {
        std::unique_lock lock(mutex);
        if (stop || generation != mine) return false;
        while (frames > 0) {
            changed.wait(lock, [&] { return stop || generation != mine || count < kSoundAhead; });
            if (stop || generation != mine) return false;
            const size_t end = (begins + count) % kSoundAhead;
            const size_t some =
                std::min({static_cast<size_t>(frames), kSoundAhead - count, kSoundAhead - end});
            if (stereo) {
                std::copy_n(stereo, 2 * some, ring.begin() + static_cast<ptrdiff_t>(2 * end));
                stereo += 2 * some;
            } else {
                std::fill_n(ring.begin() + static_cast<ptrdiff_t>(2 * end), 2 * some, int16_t{0});
            }
            count += some;
            frames -= static_cast<int64_t>(some);
            changed.notify_all();
        }
        return true;
    }

    // Decodes from this frame on, looping, until stopped or sought.
    void decode(int64_t at, int mine) {
        std::vector<int16_t> samples;
        while (decoder.seek(at)) {
            while (at < pass) {
                const int64_t first = decoder.next(samples);
                if (first < 0) break;
                const auto frames = static_cast<int64_t>(samples.size() / 2);
                const int64_t hole = std::clamp<int64_t>(first - at, 0, pass - at);
                const int64_t past = std::clamp<int64_t>(at - first, 0, frames); // before `at`
                if (!put(nullptr, hole, mine)) return;
                at += hole;
                const int64_t some = std::min(frames - past, pass - at);
                if (!put(samples.data() + 2 * past, some, mine)) return;
                at += some;
            }
            if (!put(nullptr, pass - at, mine)) return;
            at = 0;
        }
        const std::lock_guard lock(mutex);
        broken = true;
        changed.notify_all();
    }

    void run() {
        lowerThreadPriority();
        std::unique_lock lock(mutex);
        int done = 0; // nothing is read before the first seek()
        while (true) {
            changed.wait(lock, [&] { return stop || (generation != done && !broken); });
            if (stop) return;
            done = generation;
            const int64_t at = wanted % pass;
            lock.unlock();
            decode(at, done);
            lock.lock();
        }
    }
};

Result<SoundTrack> SoundTrack::open(const Path& file, double passLength_s) {
    auto decoder = SoundDecoder::open(file);
    if (!decoder) return decoder.error();
    auto impl = std::make_unique<Impl>(std::move(*decoder));
    if (!(passLength_s > 0)) passLength_s = impl->decoder.length_s();
    if (!(passLength_s > 0)) passLength_s = kLongest_s;
    impl->pass = std::llround(std::clamp(passLength_s, kShortest_s, kLongest_s) * kSoundRate_Hz);
    impl->thread = std::thread([raw = impl.get()] { raw->run(); });
    return SoundTrack(std::move(impl));
}

SoundTrack::SoundTrack(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SoundTrack::SoundTrack(SoundTrack&&) noexcept = default;
SoundTrack& SoundTrack::operator=(SoundTrack&&) noexcept = default;
SoundTrack::~SoundTrack() = default;

int64_t SoundTrack::passLength() const { return impl_->pass; }

void SoundTrack::seek(int64_t frame) {
    Impl& t = *impl_;
    {
        const std::lock_guard lock(t.mutex);
        ++t.generation;
        t.wanted = std::max<int64_t>(frame, 0);
        t.begins = t.count = 0;
    }
    t.changed.notify_all();
}

size_t SoundTrack::read(std::span<int16_t> stereo, bool wait) {
    Impl& t = *impl_;
    const size_t frames = stereo.size() / 2;
    size_t got = 0;
    std::unique_lock lock(t.mutex);
    while (got < frames) {
        if (wait) t.changed.wait(lock, [&] { return t.count > 0 || t.broken; });
        if (t.count == 0 && t.broken) {
            std::fill(stereo.begin() + static_cast<ptrdiff_t>(2 * got), stereo.end(), int16_t{0});
            return frames;
        }
        const size_t some = std::min({frames - got, t.count, kSoundAhead - t.begins});
        if (some == 0) break;
        std::copy_n(t.ring.begin() + static_cast<ptrdiff_t>(2 * t.begins), 2 * some,
                    stereo.begin() + static_cast<ptrdiff_t>(2 * got));
        got += some;
        t.begins = (t.begins + some) % kSoundAhead;
        t.count -= some;
        t.changed.notify_all();
    }
    return got;
}

} // namespace shoal::media
