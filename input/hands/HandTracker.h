// The interface of hand trackers: a device on a thread of its own, and the stream in which its frames of
// hands reach the game's thread.
#pragma once

#include "engine/scene/HandPose.h"

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

// State of a tracker, for a person to read.
struct DeviceState {
    bool present = false;    // frames come, or would if there were hands
    std::string description; // "protocol 6, peripheral attached", "not there", ...
    std::string instruction; // an instruction for the player, such as to hold a hand up; empty: none

    bool operator==(const DeviceState&) const = default;
};

// A queue of frames with one writer, the tracker's thread, and one reader.
class HandStream {
  public:
    // What push() does when the queue is full: drop the oldest frame, or wait for room.
    enum class Full { Drop, Wait };
    explicit HandStream(size_t capacity = 1024, Full full = Full::Drop);

    void push(const HandFrame& frame);
    bool take(HandFrame& out); // the oldest frame; false: none
    // Blocks until there is a frame, or the time is over: for programs that do not run in real time.
    bool wait(std::chrono::milliseconds maximum);
    void close(); // no call waits any longer

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

// Tracks until it is destroyed.
class HandTracker {
  public:
    virtual ~HandTracker() = default;
    HandTracker(const HandTracker&) = delete;
    HandTracker& operator=(const HandTracker&) = delete;

    const char* name() const { return name_; } // "Leap Motion"
    HandStream& stream() { return stream_; }

  protected:
    explicit HandTracker(const char* name, size_t capacity = 1024,
                         HandStream::Full full = HandStream::Full::Drop)
        : name_(name), stream_(capacity, full) {}

  private:
    const char* name_;
    HandStream stream_;
};

} // namespace shoal::hands
