// A fake gamepad. This library replaces the system's functions for /dev/input, so that GLFW and our force
// feedback find one Xbox 360 pad through their own code for Linux. The program that plays must link it.
#pragma once

#include <linux/input-event-codes.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace shoal::test {

struct Rumble {
    uint16_t strong = 0, weak = 0; // both 0: stopped
};

class FakeGamepad {
  public:
    // Called before GLFW reads the pad's events, twice a frame, on the thread that does. May press and move.
    std::function<void()> onPoll;

    // button: BTN_SOUTH and so on.
    void press(int button) { push(EV_KEY, button, 1); }
    void release(int button) { push(EV_KEY, button, 0); }
    // ABS_X, ABS_Y: left stick, ABS_RX, ABS_RY: right stick, -32768 to 32767, down positive; ABS_Z, ABS_RZ:
    // triggers, 0 to 255; ABS_HAT0X, ABS_HAT0Y: -1 to 1, down positive.
    void move(int axis, int value) { push(EV_ABS, axis, value); }

    std::vector<Rumble> felt() const; // rumbles in order, without repetitions
    bool opened() const;              // true if the pad was opened for its events

    // Used by the functions that stand in for the system's.
    struct Event {
        uint16_t type, code;
        int32_t value;
    };
    bool poll(Event& event); // false: nothing more until the next poll
    int open();
    void close(int fd);
    bool isOpen(int fd) const;
    void upload(const Rumble& rumble) { uploaded_ = rumble; }
    void play(bool on);
    int32_t axis(int code) const { return axes_[code]; }

  private:
    void push(uint16_t type, int code, int value);

    mutable std::mutex mutex_; // of all below: the haptics have a thread of their own
    std::vector<Event> events_;
    bool polled_ = false;
    int32_t axes_[ABS_CNT] = {};
    Rumble uploaded_;
    std::vector<Rumble> felt_;
    std::vector<int> open_;
};

FakeGamepad& fakeGamepad();

} // namespace shoal::test
