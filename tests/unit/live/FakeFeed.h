// A live feed whose pictures a test sends.
#pragma once

#include "engine/media/live/LiveFeed.h"
#include "tests/unit/media/TestFiles.h"

#include <condition_variable>
#include <deque>
#include <mutex>

namespace shoal::media::test {

// A player may keep it beyond the end of its test.
class FakeFeed final : public LiveFeed {
  public:
    FakeFeed() : LiveFeed("fake:0", "stream") {}

    // Sends a grey picture, whose number numberOf() reads back.
    void send(int number, double arrived_s = 0, int width = 64, int height = 32) {
        change([&] { events_.push_back({number, arrived_s, width, height, {}}); });
    }
    void breakOff(std::string why) {
        change([&] { events_.push_back({.broken = std::move(why)}); });
    }
    void refuse(std::string why) { // open() fails with this message until it is empty
        change([&] { refusal_ = std::move(why); });
    }
    void block(bool deaf) { // blocks open() and read(); deaf: an interruption does not end that
        change([&] { blocked_ = true, deaf_ = deaf; });
    }
    void unblock() {
        change([&] { blocked_ = false; });
    }
    int opened() const {
        const std::lock_guard lock(mutex_);
        return opened_;
    }

    Status open() override {
        std::unique_lock lock(mutex_);
        ++opened_;
        wait(lock, [&] { return !blocked_; });
        if (!refusal_.empty()) return Error{"", refusal_};
        return Done{};
    }
    Result<LivePicture> read(ImageRgb8& bgr) override {
        std::unique_lock lock(mutex_);
        wait(lock, [&] { return !blocked_ && !events_.empty(); });
        if (events_.empty()) return Error{"", "was interrupted"};
        const Event event = events_.front();
        events_.pop_front();
        if (!event.broken.empty()) return Error{"", event.broken};
        bgr.fit(event.width, event.height);
        std::fill(bgr.pixels.begin(), bgr.pixels.end(),
                  static_cast<uint8_t>(kFirstGrey + kGreyStep * event.number));
        return LivePicture{event.arrived_s, 1, 0};
    }
    void interrupt() override {
        change([&] { interrupted_ = true; });
    }

  private:
    struct Event {
        int number = 0;
        double arrived_s = 0;
        int width = 0, height = 0;
        std::string broken;
    };
    template <class Change> void change(Change&& change) {
        const std::lock_guard lock(mutex_);
        change();
        changed_.notify_all();
    }
    template <class Ready> void wait(std::unique_lock<std::mutex>& lock, Ready&& ready) {
        changed_.wait(lock, [&] { return ready() || (interrupted_ && !(blocked_ && deaf_)); });
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Event> events_;
    std::string refusal_;
    bool blocked_ = false, deaf_ = false, interrupted_ = false;
    int opened_ = 0;
};

} // namespace shoal::media::test
