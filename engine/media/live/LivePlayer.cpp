#include "engine/media/live/LivePlayer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace shoal::media {

using Seconds = std::chrono::duration<double>;
using Slot = FrameSlots::Slot;
using State = FrameSlots::State;

constexpr Seconds kPollInterval{0.05};
constexpr Seconds kJoinTimeout{2}; // time limit for a feed that cannot be interrupted

double liveNow_s() { return Seconds(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct LivePlayer::Impl {
    std::shared_ptr<LiveFeed> feed;
    LiveOptions options;

    std::mutex mutex;
    std::condition_variable changed;
    // Guarded by mutex:
    FrameSlots slots; // the decode thread alone accesses the slot in State::Filling, without the lock
    LiveCounts counts;
    double lastMade_s = 0;
    bool lost = false;
    std::string reason; // why the connection was lost
    bool stop = false;
    bool inFeed = false; // whether the decode thread is in a call to the feed, which may block
    bool finished = false;
    std::thread thread;

    // Used by the render thread only:
    LiveState state = LiveState::Playing;
    std::string notice, noticedReason;
    std::array<double, 64> calls_s{}; // ring buffer: times of the last calls of newest()
    size_t callCount = 0;
    int displayFrames = 0;

    // Used by the decode thread only:
    Layout layout = Layout::Mono;
    int width = 0, height = 0;

    // --- Decode thread -------------------------------------------------------------------------------------

    // Runs `call` unlocked. Returns false if the player ends.
    template <class Call> bool inCall(std::unique_lock<std::mutex>& lock, Call&& call) {
        inFeed = true;
        lock.unlock();
        call();
        lock.lock();
        inFeed = false;
        changed.notify_all();
        return !stop;
    }

    void findLayout(const ImageRgb8& picture) {
        if (picture.width == width && picture.height == height) return;
        if (width > 0) ++counts.resized;
        width = picture.width;
        height = picture.height;
        layout = options.layout;
        // 2:1 is mono by its shape; the content of one picture is too little evidence for two eyes' halves.
        if (layout == Layout::Auto) layout = layoutFromShape(width, height);
        if (layout == Layout::Auto) layout = layoutFromContent(picture);
        if (layout == Layout::Auto) layout = Layout::Mono;
    }

    // Reads pictures until the feed fails or the player ends. Returns the feed's error.
    Error play(std::unique_lock<std::mutex>& lock) {
        while (!stop) {
            Slot& slot = *slots.find(State::Free); // of three slots, at most one is shown and one ready
            slot.state = State::Filling;
            Result<int64_t> skipped = Error{};
            ImageRgb8& bgr = slots.pixelsOf(slot, options);
            const bool going = inCall(lock, [&] { skipped = feed->read(bgr, slot.frame); });
            if (!going || !skipped) {
                slot.state = State::Free;
                return skipped ? Error{} : skipped.error();
            }
            findLayout(bgr);
            slot.frame.layout = layout;
            slot.frame.index = counts.made;
            lock.unlock();
            slots.prepare(slot, options);
            lock.lock();
            if (Slot* unseen = slots.find(State::Ready)) {
                unseen->state = State::Free;
                ++counts.skipped;
            }
            slot.state = State::Ready;
            counts.skipped += *skipped;
            ++counts.made;
            lastMade_s = options.now_s();
            lost = false;
            changed.notify_all();
        }
        return Error{};
    }

    void run() {
        // Runs at normal priority, unlike a file's decode thread: live pictures cannot be decoded ahead.
        double delay_s = options.retryFirst_s;
        std::unique_lock lock(mutex);
        while (!stop) {
            Status opened = Error{};
            if (!inCall(lock, [&] { opened = feed->open(); })) break;
            const int64_t before = counts.made;
            const Error why = opened ? play(lock) : opened.error();
            if (stop) break;
            if (!lost) ++counts.losses;
            lost = true;
            reason = why.reason;
            changed.notify_all();
            if (counts.made > before) delay_s = options.retryFirst_s;
            changed.wait_for(lock, Seconds(delay_s), [&] { return stop; });
            delay_s = std::min(2 * delay_s, options.retryMax_s);
        }
        finished = true;
        changed.notify_all();
    }

    // --- Render thread -------------------------------------------------------------------------------------

    // Stops the decode thread and joins it; detaches it if the feed blocks for longer than kJoinTimeout.
    void end() {
        std::unique_lock lock(mutex);
        stop = true;
        changed.notify_all();
        lock.unlock();
        feed->interrupt();
        lock.lock();
        changed.wait_for(lock, kJoinTimeout, [&] { return finished; });
        changed.wait(lock, [&] { return finished || inFeed; });
        const bool joins = finished;
        lock.unlock();
        joins ? thread.join() : thread.detach();
    }

    // Shows the ready frame; needs the lock. Returns false if there is none.
    bool takeReady() {
        Slot* ready = slots.find(State::Ready);
        if (!ready) return false;
        slots.show(*ready);
        ++counts.shown;
        return true;
    }

    // Needs the lock.
    void updateState() {
        const LiveState now = lost                                      ? LiveState::Lost
                              : options.now_s() - lastMade_s > kStill_s ? LiveState::Stopped
                                                                        : LiveState::Playing;
        if (now == state && (now != LiveState::Lost || noticedReason == reason)) return;
        if (now != LiveState::Playing && state == LiveState::Playing) ++counts.stops;
        state = now;
        noticedReason = reason;
        notice.clear();
        if (now == LiveState::Stopped)
            notice = fmt::format("The {} has stopped; showing its last picture", feed->kind);
        if (now == LiveState::Lost)
            notice = fmt::format("The {} {}; showing its last picture, and trying again", feed->kind, reason);
    }
};

Result<LivePlayer> LivePlayer::open(std::shared_ptr<LiveFeed> feed, LiveOptions options,
                                    const std::function<bool()>& wait) {
    auto impl = std::make_shared<Impl>();
    impl->feed = std::move(feed);
    impl->options = std::move(options);
    // The thread shares ownership of *impl, because it outlives the player if it is detached.
    impl->thread = std::thread([impl] { impl->run(); });
    LivePlayer player(Owner(impl.get(), [impl](Impl*) { impl->end(); }));

    const double deadline_s = liveNow_s() + impl->options.firstPicture_s;
    std::unique_lock lock(impl->mutex); // unlocked before ~LivePlayer(), which locks it
    const auto failed = [&](std::string why) { return Error{impl->feed->name, std::move(why)}; };
    while (!impl->takeReady()) {
        if (impl->lost) return failed(impl->reason);
        if (liveNow_s() >= deadline_s) return failed("no picture has come");
        impl->changed.wait_for(lock, kPollInterval);
        lock.unlock();
        const bool go = !wait || wait();
        lock.lock();
        if (!go) return failed("the wait for its first picture was cancelled");
    }
    return player;
}

const VideoFrame* LivePlayer::newest() {
    Impl& p = *impl_;
    const std::lock_guard lock(p.mutex);
    p.calls_s[p.callCount++ % p.calls_s.size()] = p.options.now_s();
    if (p.takeReady()) {
        const double arrived_s = p.slots.shown().arrived_s;
        const auto recorded = static_cast<ptrdiff_t>(std::min(p.callCount, p.calls_s.size()));
        p.displayFrames = static_cast<int>(std::count_if(p.calls_s.begin(), p.calls_s.begin() + recorded,
                                                         [&](double call_s) { return call_s >= arrived_s; }));
    }
    p.updateState();
    return &p.slots.shown();
}

int LivePlayer::displayFrames() const { return impl_->displayFrames; }

double LivePlayer::age_s() const { return impl_->options.now_s() - impl_->slots.shown().arrived_s; }

LiveState LivePlayer::state() const { return impl_->state; }
const std::string& LivePlayer::notice() const { return impl_->notice; }

LiveCounts LivePlayer::counts() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->counts;
}

Result<std::string> checkLive(const LiveAddress& address) {
    const auto feed = feedFrom(address);
    auto player = LivePlayer::open(feed);
    if (!player) return player.error();
    const VideoFrame& frame = *player->newest();
    return fmt::format(
        "a live {} of {}x{}{}, lat-long {}", feed->kind, frame.pixelsBgr.width, frame.pixelsBgr.height,
        frame.radianceLin.empty() ? "" : " of high dynamic range, lit as measured", enumName(frame.layout));
}

} // namespace shoal::media
