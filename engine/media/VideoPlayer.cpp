#include "engine/media/VideoPlayer.h"

#include "engine/core/ThreadPool.h"
#include "engine/media/VideoSource.h"

#include <fmt/core.h>

#include <condition_variable>
#include <future>
#include <limits>
#include <mutex>
#include <thread>

namespace shoal::media {

using Clock = std::chrono::steady_clock;
using Slot = FrameSlots::Slot;
using State = FrameSlots::State;

// Decoding up to a key frame that is so many frames ahead is about as quick as a seek to it, after which each
// of the decoder's threads starts anew.
constexpr int64_t kSeekAhead = 8;
constexpr double kLongestStep_s = 0.25; // of nextFrame()
constexpr double kBackwardSlack_s = 0.5;

struct VideoPlayer::Impl {
    Path file;
    PlayerOptions options;

    std::mutex mutex;
    std::condition_variable_any changed;
    // Guarded by mutex:
    FrameSlots slots;       // the decode thread owns the one being filled; the others' frames are constant
    int64_t wanted = 0;     // unwrapped index that the render thread asked for last
    bool exact = true;      // whether it waits for exactly that one
    int64_t made = -1;      // index of the frame made last
    int64_t passLength = 0; // frames in a pass; 0 until the end has been seen
    int64_t last = std::numeric_limits<int64_t>::max(); // last frame that can be decoded
    bool broken = false; // nothing more can be decoded; before the first frame: open() fails
    bool damaged = false;
    std::string message;

    // Used by the decode thread only, but for source.info(), which is constant:
    VideoSource source;
    DecodingCost cost;
    bool hurries = false; // see NextFrame
    bool counted = false; // whether passLength was counted; else it is the stated one

    std::jthread thread; // last: it uses all of the above

    explicit Impl(VideoSource opened) : source(std::move(opened)) {}

    int64_t indexAt(double time_s) const {
        if (!(time_s > 0)) return 0; // also NaN
        // Adds a millionth of a frame, so that i / fps is frame i in spite of rounding; below 2^53 frames.
        return static_cast<int64_t>(std::min(time_s, 1e9) * source.info().fps + 1e-6);
    }

    int64_t due() const { return std::min(wanted, last); }
    // Returns how far ahead of the due frame, in frames, pictures are kept and decoding need not go back.
    int64_t slack() const { return static_cast<int64_t>(kBackwardSlack_s * source.info().fps + kFrameSlots); }

    // --- Decode thread -------------------------------------------------------------------------------------

    bool isThere(int64_t index) {
        return std::ranges::any_of(slots, [&](const Slot& slot) {
            return slot.frame.index == index && (slot.state == State::Ready || slot.state == State::Shown);
        });
    }

    // Returns the frame to make next; -1 if there is none.
    int64_t nextTarget() {
        if (broken) return -1;
        NextFrame next{due()};
        if (!exact && made - due() <= slack()) {
            const int64_t stated = passLength > 0 ? passLength : source.info().frameCount;
            next = nextFrame(made, due(), cost, kLongestStep_s * source.info().fps, [&](int64_t index) {
                const int64_t number = stated > 0 ? index % stated : index;
                return index - number + source.keyFrameBefore(number);
            });
            next.index = std::min(next.index, std::max(last, made + 1));
            // A late film goes on by its stated length; counting its frames would decode it to the end.
            if (stated > 0 && next.index >= stated && next.index > made + 1) passLength = stated;
        }
        while (isThere(next.index)) ++next.index;
        hurries = next.hurries;
        return next.index > last ? -1 : next.index;
    }

    // Returns a free slot, or for a frame that is due already the slot of the ready frame furthest ahead.
    Slot* slotFor(int64_t target) {
        Slot* found = slots.find(State::Free);
        if (found || target > due()) return found;
        for (Slot& slot : slots)
            if (slot.state == State::Ready && (!found || slot.frame.index > found->frame.index))
                found = &slot;
        return found;
    }

    void run(const std::stop_token& ending) {
        lowerThreadPriority();
        std::unique_lock lock(mutex);
        int64_t target = -1;
        Slot* slot = nullptr;
        const auto isNeeded = [&] {
            target = nextTarget();
            slot = target < 0 ? nullptr : slotFor(target);
            return slot != nullptr;
        };
        while (changed.wait(lock, ending, isNeeded) && !ending.stop_requested()) {
            slot->state = State::Filling;
            slot->frame.index = target;
            slot->frame.number = passLength > 0 ? target % passLength : target;
            slot->frame.time_s = static_cast<double>(slot->frame.number) / source.info().fps;
            lock.unlock();
            const int64_t had = fill(*slot, ending);
            lock.lock();
            const bool filled = had > slot->frame.number;
            slot->state = filled ? State::Ready : State::Free;
            if (filled)
                made = target;
            else if (!ending.stop_requested())
                ended(target - slot->frame.number, had);
            changed.notify_all();
        }
    }

    // Decodes the frame's picture. Returns how many pictures the video is known to have: more than
    // frame.number on success, else at most that many (it ends before, or the thread is to stop).
    int64_t fill(Slot& slot, const std::stop_token& ending) {
        const int64_t number = slot.frame.number;
        const auto began = Clock::now();
        if (number < source.position() || source.keyFrameBefore(number) > source.position() + kSeekAhead)
            if (!source.seek(number)) return 0;
        const int64_t first = std::min(source.position(), number);
        auto start = began;
        while (source.position() <= number) {
            if (ending.stop_requested()) return 0;
            start = Clock::now();
            if (!source.grab(hurries)) return source.position();
        }
        const auto decoded = Clock::now();
        if (!source.retrieve(slots.pixelsOf(slot, options), &slot.frame.radianceLin)) return number;
        if (options.keepPlanes) source.share(slot.frame);
        slot.frame.chromaTexels = source.chromaTexels();
        slot.frame.decode_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        slots.prepare(slot, options);
        const std::chrono::duration<double> decoding = decoded - began, showing = Clock::now() - decoded;
        const double fps = source.info().fps;
        cost.follow(number + 1 - first, decoding.count() * fps, showing.count() * fps);
        return number + 1;
    }

    // Handles the end of a pass that began at index `pass` and gave only `count` frames. Needs the lock.
    void ended(int64_t pass, int64_t count) {
        const int64_t stated = passLength > 0 ? passLength : source.info().frameCount;
        // After they were counted, fewer frames mean that the file has changed.
        if (made >= 0 && !counted && count >= leastFrames(stated)) {
            passLength = count;
            counted = true;
            return;
        }
        // Gives up if there is no good frame, or if reading fails again before the last good one.
        broken = broken || made < 0 || damaged || pass + count == 0;
        last = std::min(last, pass + count - 1);
        made = std::min(made, last);
        if (std::exchange(damaged, true)) return;
        message = fmt::format("{}: stopped at {:.1f} s: the file is damaged there; the last good frame stays",
                              file.string(), static_cast<double>(count) / source.info().fps);
    }

    // --- Render thread, with the lock held -----------------------------------------------------------------

    // Shows the newest ready frame of low .. high, if any, and frees those that are too old or too far ahead.
    bool showReady(int64_t low, int64_t high) {
        Slot* newest = nullptr;
        for (Slot& slot : slots) {
            if (slot.state != State::Ready) continue;
            if (slot.frame.index < low || slot.frame.index > high + slack()) slot.state = State::Free;
            if (slot.frame.index < low || slot.frame.index > high) continue;
            if (newest) (newest->frame.index < slot.frame.index ? *newest : slot).state = State::Free;
            if (!newest || newest->frame.index < slot.frame.index) newest = &slot;
        }
        if (newest) slots.show(*newest);
        return newest != nullptr;
    }
};

Result<VideoPlayer> VideoPlayer::open(const Path& file, PlayerOptions options) {
    // Opened on a thread of low priority, because the decoder's threads inherit it.
    auto source = std::async(std::launch::async, [&] {
                      lowerThreadPriority();
                      return VideoSource::open(file, options.layout, options.decoding);
                  }).get();
    if (!source) return source.error();
    auto impl = makeHidden<Impl>(std::move(*source));
    impl->file = file;
    const VideoInfo& info = impl->source.info();
    impl->options = std::move(options);
    for (Slot& slot : impl->slots) {
        slot.frame.layout = info.layout;
        impl->slots.pixelsOf(slot, impl->options) = ImageRgb8(info.width, info.height);
    }
    impl->thread = std::jthread([raw = impl.get()](const std::stop_token& ending) { raw->run(ending); });

    std::unique_lock lock(impl->mutex);
    bool shown = false;
    impl->changed.wait(lock, [&] { return (shown = impl->showReady(0, 0)) || impl->broken; });
    if (!shown) return Error{file.string(), "its first frame cannot be decoded"};
    return VideoPlayer(std::move(impl));
}

const VideoInfo& VideoPlayer::info() const { return impl_->source.info(); }

const VideoFrame* VideoPlayer::newest(double videoTime_s) {
    Impl& p = *impl_;
    const std::lock_guard lock(p.mutex);
    p.exact = false;
    p.wanted = p.indexAt(videoTime_s);
    p.showReady(0, p.wanted);
    p.changed.notify_all();
    return &p.slots.shown();
}

const VideoFrame* VideoPlayer::waitFor(double videoTime_s) {
    Impl& p = *impl_;
    std::unique_lock lock(p.mutex);
    p.exact = true;
    p.wanted = p.indexAt(videoTime_s);
    p.changed.notify_all();
    p.changed.wait(
        lock, [&] { return p.slots.shown().index == p.due() || p.broken || p.showReady(p.due(), p.due()); });
    p.exact = false;
    p.changed.notify_all();
    return &p.slots.shown();
}

std::string VideoPlayer::status() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->message, {});
}

} // namespace shoal::media
