#include "engine/media/VideoPlayer.h"

#include "engine/core/Threads.h"
#include "engine/media/VideoSource.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <future>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace shoal::media {

namespace {

using Clock = std::chrono::steady_clock;

// A jump ahead of more than this is a seek: below it, decoding through is about as quick.
constexpr double kSeekAhead_s = 3;
// While catching up in newest(), one of so many frames is shown.
constexpr int64_t kMaxSkip = 15;
constexpr double kBackwardSlack_s = 0.5;
// Frames that a pass may have fewer than stated without counting as damaged: containers count frames that
// their edit list or a missing key frame hides.
constexpr int64_t kMissingFrames = 4;
constexpr double kMissingShare = 0.02;

constexpr int64_t kEndless = std::numeric_limits<int64_t>::max();

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

} // namespace

struct VideoPlayer::Impl {
    enum class State { Free, Filling, Ready, Shown };
    struct Slot {
        VideoFrame frame;
        State state = State::Free;
        int64_t generation = 0;
    };

    Path file;
    VideoInfo info;
    std::function<void(const VideoFrame&, int)> prepare;

    mutable std::mutex mutex;
    std::condition_variable changed;
    // Guarded by mutex:
    std::vector<Slot> slots; // the slot being filled is the decode thread's, the others' frames are constant
    int shown = -1;
    int64_t wanted = 0;    // unwrapped index that the frame's thread asked for last
    bool exact = false;    // it is waiting for just that one
    int64_t lastMade = -1; // newest index that was begun in this generation
    int64_t generation = 0;
    int64_t passLength = 0;  // frames in a pass; 0 until the end was seen
    int64_t last = kEndless; // last frame that can be decoded
    bool broken = false;     // nothing more can be decoded; before the first frame: open() fails
    bool reported = false;
    std::string message;
    VideoCounts counts;

    std::atomic<bool> stop{false};
    VideoSource source;              // the decode thread's
    std::optional<ImageRgb8> pixels; // the decode thread's: of all slots, if they do not keep theirs
    std::thread thread;

    explicit Impl(VideoSource opened) : source(std::move(opened)) {}

    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            stop = true;
        }
        changed.notify_all();
        if (thread.joinable()) thread.join();
    }

    int64_t indexAt(double time_s) const {
        if (!(time_s > 0)) return 0; // also NaN
        // A millionth of a frame, so that i / fps is frame i in spite of rounding; below 2^53 frames.
        return static_cast<int64_t>(std::min(time_s, 1e9) * info.fps + 1e-6);
    }

    // --- Decode thread -------------------------------------------------------------------------------------

    int freeSlot() const {
        for (size_t i = 0; i < slots.size(); ++i)
            if (slots[i].state == State::Free) return static_cast<int>(i);
        return -1;
    }

    // The frame to make next; -1 if there is none to make.
    int64_t nextTarget() const {
        if (broken) return -1;
        const int64_t due = std::min(wanted, last);
        const int64_t following = lastMade + 1;
        if (due <= lastMade) return following <= last ? following : -1;
        if (exact || static_cast<double>(due - following) > kSeekAhead_s * info.fps) return due;
        return std::min(due, following + kMaxSkip);
    }

    void run() {
        lowerThreadPriority();
        std::unique_lock lock(mutex);
        while (!stop) {
            const int slotIndex = freeSlot();
            const int64_t target = nextTarget();
            if (slotIndex < 0 || target < 0) {
                changed.wait(lock);
                continue;
            }
            Slot& slot = slots[static_cast<size_t>(slotIndex)];
            slot.state = State::Filling;
            slot.generation = generation;
            slot.frame.index = target;
            const int64_t before = lastMade;
            lastMade = target;
            const int64_t number = passLength > 0 ? target % passLength : target;

            lock.unlock();
            int64_t skipped = 0, seeks = 0;
            const int64_t had = fill(slot.frame, slotIndex, number, skipped, seeks);
            lock.lock();

            counts.skipped += skipped;
            counts.seeks += seeks;
            slot.state = State::Free;
            if (had > number) {
                ++counts.made;
                if (slot.generation == generation) slot.state = State::Ready;
            } else if (!stop) {
                if (slot.generation == generation) lastMade = before;
                ended(target - number, had);
            }
            changed.notify_all();
        }
    }

    // Brings picture `number` of the video into the frame. Returns how many pictures the video has as far as
    // could be seen: more than number, or fewer if it ends before (or the thread is to stop).
    int64_t fill(VideoFrame& frame, int slotIndex, int64_t number, int64_t& skipped, int64_t& seeks) {
        const auto seekAhead = static_cast<int64_t>(kSeekAhead_s * info.fps);
        if (number < source.position() || number > source.position() + seekAhead) {
            ++seeks;
            if (!source.seek(number)) return 0;
        }
        auto start = Clock::now();
        while (source.position() <= number) {
            if (stop) return 0;
            start = Clock::now();
            if (!source.grab()) return source.position();
            if (source.position() <= number) ++skipped;
        }
        if (pixels) std::swap(frame.pixelsBgr, *pixels);
        const bool had = source.retrieve(frame.pixelsBgr);
        frame.decode_ms = msSince(start);
        frame.number = number;
        frame.pts_s = static_cast<double>(frame.index) / info.fps;
        start = Clock::now();
        if (had && prepare) prepare(frame, slotIndex);
        frame.prepare_ms = msSince(start);
        if (pixels) std::swap(frame.pixelsBgr, *pixels);
        return had ? number + 1 : number;
    }

    // The pass that began at index `pass` gave only `count` frames. With the lock held.
    void ended(int64_t pass, int64_t count) {
        const int64_t stated = passLength > 0 ? passLength : info.frameCount;
        const int64_t missing =
            std::max(kMissingFrames, static_cast<int64_t>(kMissingShare * static_cast<double>(stated)));
        // A known pass length was counted, so fewer frames mean that the file has changed.
        const bool damaged = passLength > 0 || count < stated - missing;
        if (damaged || counts.made == 0) {
            // Failed before the last good frame when read again: give up.
            broken = broken || counts.made == 0 || last != kEndless || pass + count == 0;
            last = std::min(last, pass + count - 1);
            lastMade = std::min(lastMade, last);
            if (reported) return;
            reported = true;
            char text[96];
            std::snprintf(text, sizeof text,
                          "stopped at %.1f s: the file is damaged there; the last good frame stays",
                          static_cast<double>(count) / info.fps);
            message = file.string() + ": " + text;
        } else {
            passLength = count;
        }
    }

    // --- Frame's thread, with the lock held ----------------------------------------------------------------

    void show(int slotIndex) {
        if (shown >= 0) slots[static_cast<size_t>(shown)].state = State::Free;
        shown = slotIndex;
        slots[static_cast<size_t>(slotIndex)].state = State::Shown;
        ++counts.shown;
    }

    // Discards frames read ahead and continues with this one.
    void restartAt(int64_t index) {
        ++generation;
        lastMade = index - 1;
        for (Slot& slot : slots)
            if (slot.state == State::Ready) slot.state = State::Free;
    }

    bool inWork(int64_t index) const {
        return std::any_of(slots.begin(), slots.end(), [&](const Slot& slot) {
            return slot.state == State::Filling && slot.generation == generation && slot.frame.index == index;
        });
    }

    // The ready slot with the largest index in low .. high, or -1. Frees the ready ones below it.
    int takeReady(int64_t low, int64_t high) {
        int best = -1;
        for (size_t i = 0; i < slots.size(); ++i) {
            Slot& slot = slots[i];
            if (slot.state != State::Ready || slot.frame.index > high) continue;
            if (best >= 0 && slots[static_cast<size_t>(best)].frame.index > slot.frame.index) {
                slot.state = State::Free;
                continue;
            }
            if (best >= 0) slots[static_cast<size_t>(best)].state = State::Free;
            best = static_cast<int>(i);
        }
        if (best >= 0 && slots[static_cast<size_t>(best)].frame.index < low) {
            slots[static_cast<size_t>(best)].state = State::Free;
            best = -1;
        }
        return best;
    }

    const VideoFrame* shownFrame() const { return &slots[static_cast<size_t>(shown)].frame; }
};

Result<VideoPlayer> VideoPlayer::open(const Path& file, VideoOptions options) {
    assert(options.slots >= 3);
    // On a thread of low priority, because the decoder's threads inherit it.
    auto source = std::async(std::launch::async, [&] {
                      lowerThreadPriority();
                      return VideoSource::open(file);
                  }).get();
    if (!source) return source.error();
    VideoInfo info;
    const Error undecodable{file.string(), "its first frame cannot be decoded"};
    if (!resolveLayout(*source, options.layout, info)) return undecodable;

    auto impl = std::make_unique<Impl>(std::move(*source));
    impl->file = file;
    impl->info = info;
    impl->prepare = std::move(options.prepare);
    impl->slots.resize(static_cast<size_t>(options.slots));
    const ImageRgb8 blank(info.width, info.height);
    if (!options.keepPixels) impl->pixels = blank;
    for (auto& slot : impl->slots)
        if (options.keepPixels) slot.frame.pixelsBgr = blank;
    impl->thread = std::thread([raw = impl.get()] { raw->run(); });

    std::unique_lock lock(impl->mutex);
    int first = -1;
    impl->changed.wait(lock, [&] { return (first = impl->takeReady(0, 0)) >= 0 || impl->broken; });
    if (first >= 0) impl->show(first);
    lock.unlock();
    if (first < 0) return undecodable;
    return VideoPlayer(std::move(impl));
}

VideoPlayer::VideoPlayer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VideoPlayer::VideoPlayer(VideoPlayer&&) noexcept = default;
VideoPlayer& VideoPlayer::operator=(VideoPlayer&&) noexcept = default;
VideoPlayer::~VideoPlayer() = default;

const VideoInfo& VideoPlayer::info() const { return impl_->info; }

const VideoFrame* VideoPlayer::newest(double videoTime_s) {
    Impl& p = *impl_;
    const std::lock_guard lock(p.mutex);
    p.exact = false;
    p.wanted = p.indexAt(videoTime_s);
    const auto slack =
        static_cast<int64_t>(kBackwardSlack_s * p.info.fps) + static_cast<int64_t>(p.slots.size());
    if (std::min(p.wanted, p.last) + slack < p.lastMade) p.restartAt(p.wanted);
    if (const int ready = p.takeReady(0, p.wanted); ready >= 0) p.show(ready);
    p.changed.notify_all();
    return p.shownFrame();
}

const VideoFrame* VideoPlayer::waitFor(double videoTime_s) {
    Impl& p = *impl_;
    std::unique_lock lock(p.mutex);
    p.exact = true;
    p.wanted = p.indexAt(videoTime_s);
    for (;;) {
        const int64_t due = std::min(p.wanted, p.last);
        if (p.shownFrame()->index == due || p.broken) break;
        if (const int ready = p.takeReady(due, due); ready >= 0) {
            p.show(ready);
            break;
        }
        if (due <= p.lastMade && !p.inWork(due)) p.restartAt(due);
        p.changed.notify_all();
        p.changed.wait(lock);
    }
    p.exact = false;
    p.changed.notify_all();
    return p.shownFrame();
}

int VideoPlayer::slotOf(const VideoFrame& frame) const {
    for (size_t i = 0; i < impl_->slots.size(); ++i)
        if (&impl_->slots[i].frame == &frame) return static_cast<int>(i);
    assert(!"a frame of another player");
    return -1;
}

std::string VideoPlayer::status() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->message, {});
}

VideoCounts VideoPlayer::counts() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->counts;
}

} // namespace shoal::media
