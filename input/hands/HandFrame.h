// What a hand-tracking device sees at one moment, and the way from its thread to the game's.
#pragma once

#include "input/hands/HandPose.h"

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>

namespace shoal::hands {

struct HandFrame {
    int64_t time_us = 0;               // by the device's clock; may start anew when the device does
    std::array<HandPose, 2> hands{};   // left, right; unfiltered, viewer's frame
    std::array<int64_t, 2> identity{}; // changes when the device no longer knows that it is the same hand
};

// How a device is, for a person to read.
struct DeviceState {
    bool present = false; // frames come, or would if there were hands
    std::string words;    // "protocol 6, peripheral attached", "not there", ...
    std::string asks;     // of the player, such as to hold a hand up; empty: nothing

    bool operator==(const DeviceState&) const = default;
};

// One writer, one reader.
class HandStream {
  public:
    // Takes a frame in. When it is full: waits for room, or drops the oldest frame.
    enum class Full { Drop, Wait };
    explicit HandStream(size_t capacity = 1024, Full full = Full::Drop);

    void push(const HandFrame& frame);
    bool take(HandFrame& out); // the oldest frame; false: none
    // Blocks until there is a frame, or the time is over: for programs whose time is not the clock's.
    bool wait(std::chrono::milliseconds most);
    void close(); // nobody waits any longer

    void setState(DeviceState state);
    DeviceState state() const;
    uint64_t stateChanges() const { return stateChanges_; }
    uint64_t dropped() const { return dropped_; }

  private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<HandFrame> frames_;
    const size_t capacity_;
    const Full full_;
    bool closed_ = false;
    std::atomic<uint64_t> dropped_{0};
    std::atomic<uint64_t> stateChanges_{0};
    DeviceState state_;
};

} // namespace shoal::hands
