// Bounded queue of coded pictures between the reader's thread and the decoder's. If the decoder falls behind
// a live stream, packets before the newest key frame are dropped. And a rate limiter of packets.
#pragma once

#include "engine/media/Ffmpeg.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>

namespace shoal::media {

class PacketQueue {
  public:
    // Empties and opens the queue. wait: push() waits for room and drops nothing.
    void reset(bool wait);

    // --- The reader's thread

    // Takes over the packet's data. Returns false once stopped or interrupted.
    bool push(AVPacket& packet, double arrived_s);

    // Ends the queue for this reason. Packets in it can still be popped.
    void close(std::string reason);

    // Returns false if stopped or interrupted meanwhile.
    bool sleep(double seconds);

    // --- The decoder's thread

    struct Popped {
        Packet packet; // null: closed and empty, or interrupted
        double arrived_s = 0;
        int dropped = 0; // packets left out before this one
    };
    // Blocks until there is a packet.
    Popped pop();

    void stop(); // the reader's calls return false until reset()

    size_t count() const;
    std::string reason() const; // of close()

    // --- Any thread

    void interrupt(); // permanent

    static constexpr size_t kMaxPackets = 512, kMaxBytes = size_t{32} << 20, kWaitingPackets = 4;

  private:
    void drop(size_t count);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Popped> packets_;
    size_t bytes_ = 0;
    bool wait_ = false, closed_ = false, stopped_ = false, interrupted_ = false, needsKey_ = false;
    int dropped_ = 0;
    std::string reason_;
};

// Delays packets that come faster than their own time stamps (a file on a server, or written into a pipe). A
// token bucket of seconds: it fills as time passes, and each picture takes its duration. Live packets never
// wait.
class TokenBucket {
  public:
    // burst_s: seconds that may come at once: a live server may begin with its last few seconds.
    explicit TokenBucket(double burst_s) : max_s_(burst_s), left_s_(burst_s) {}

    // Returns the seconds that a packet stamped stamp_s, which came at now_s, has to wait.
    double wait_s(double stamp_s, double now_s) {
        if (!began_) {
            began_ = true;
            stamp_s_ = stamp_s;
            now_s_ = now_s;
            return 0;
        }
        // Senders' clocks run faster than ours by less than this.
        constexpr double kDrift = 1e-3;
        left_s_ = std::min(left_s_ + (now_s - now_s_) * (1 + kDrift), max_s_);
        now_s_ = now_s;
        const double duration_s = stamp_s - stamp_s_;
        stamp_s_ = stamp_s;
        if (duration_s > 0 && duration_s < kJump_s) left_s_ -= duration_s; // else the stamps restarted
        return std::max(0.0, -left_s_);
    }

  private:
    static constexpr double kJump_s = 10;
    double max_s_, left_s_;
    bool began_ = false;
    double stamp_s_ = 0, now_s_ = 0;
};

} // namespace shoal::media
