// Pictures when a test says so.
#pragma once

#include "engine/media/live/LiveFeed.h"
#include "tests/unit/media/TestFiles.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>

namespace shoal::media::test {

class FakeFeed {
  public:
    // A grey picture that numberOf() reads back.
    void send(int number, double arrived_s = 0, int width = 64, int height = 32) {
        add({number, arrived_s, width, height, {}});
    }
    void breakOff(std::string why) { add({.broken = std::move(why)}); }
    void refuse(std::string why) { // to be opened, until it is empty
        const std::lock_guard lock(state_->mutex);
        state_->refusal = std::move(why);
    }
    void block(bool deaf) { // open() and read(); deaf: interrupting does not help
        const std::lock_guard lock(state_->mutex);
        state_->blocked = true;
        state_->deaf = deaf;
    }
    void unblock() {
        const std::lock_guard lock(state_->mutex);
        state_->blocked = false;
        state_->changed.notify_all();
    }
    int opened() const {
        const std::lock_guard lock(state_->mutex);
        return state_->opened;
    }

    LiveFeed feed() const {
        const auto state = state_; // a feed may outlive its test
        return {.name = "fake:0",
                .kind = "stream",
                .open = [state]() -> Status {
                    std::unique_lock lock(state->mutex);
                    ++state->opened;
                    state->wait(lock, [&] { return !state->blocked; });
                    if (!state->refusal.empty()) return Error{"", state->refusal};
                    return Done{};
                },
                .read = [state](ImageRgb8& bgr) -> Result<LivePicture> {
                    std::unique_lock lock(state->mutex);
                    state->wait(lock, [&] { return !state->blocked && !state->events.empty(); });
                    if (state->events.empty()) return Error{"", "was interrupted"};
                    const Event event = state->events.front();
                    state->events.pop_front();
                    if (!event.broken.empty()) return Error{"", event.broken};
                    if (bgr.width != event.width || bgr.height != event.height)
                        bgr = ImageRgb8(event.width, event.height);
                    std::fill(bgr.pixels.begin(), bgr.pixels.end(),
                              static_cast<uint8_t>(kFirstGrey + kGreyStep * event.number));
                    return LivePicture{event.arrived_s, 1, 0};
                },
                .interrupt =
                    [state] {
                        const std::lock_guard lock(state->mutex);
                        state->interrupted = true;
                        state->changed.notify_all();
                    }};
    }

  private:
    struct Event {
        int number = 0;
        double arrived_s = 0;
        int width = 0, height = 0;
        std::string broken;
    };
    struct State {
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<Event> events;
        std::string refusal;
        bool blocked = false, deaf = false, interrupted = false;
        int opened = 0;

        template <class Ready> void wait(std::unique_lock<std::mutex>& lock, Ready&& ready) {
            changed.wait(lock, [&] { return ready() || (interrupted && !(blocked && deaf)); });
        }
    };
    void add(Event event) {
        const std::lock_guard lock(state_->mutex);
        state_->events.push_back(std::move(event));
        state_->changed.notify_all();
    }
    std::shared_ptr<State> state_ = std::make_shared<State>();
};

} // namespace shoal::media::test
