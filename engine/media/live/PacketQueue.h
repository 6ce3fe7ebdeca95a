// Bounded queue of coded pictures between the reader's thread and the decoder's. If the decoder falls behind
// a live stream, packets before the newest key frame are dropped. And a rate limiter of packets.
#pragma once

#include "engine/media/Ffmpeg.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

namespace shoal::media {

class PacketQueue {
  public:
    // Empties and opens the queue. wait: push() waits for room and drops nothing.
    void reset(bool wait) {
        const std::lock_guard lock(mutex_);
        drop(packets_.size());
        wait_ = wait;
        closed_ = needsKey_ = false;
        dropped_ = 0;
    }

    // --- The reader's thread

    // Takes over the packet's data. Returns false once closed or interrupted.
    bool push(AVPacket& packet, double arrived_s) {
        std::unique_lock lock(mutex_);
        if (wait_) changed_.wait(lock, [&] { return ended() || packets_.size() < kWaitingPackets; });
        if (ended()) return false;
        const bool key = packet.flags & AV_PKT_FLAG_KEY;
        const auto size = static_cast<size_t>(packet.size);
        if (!wait_ && (packets_.size() == kMaxPackets || bytes_ + size > kMaxBytes)) {
            drop(packets_.size());
            needsKey_ = true;
        }
        if (needsKey_ && !key) {
            ++dropped_;
            av_packet_unref(&packet);
            return true;
        }
        needsKey_ = false;
        packets_.push_back({makePacket(), arrived_s});
        av_packet_move_ref(packets_.back().packet.get(), &packet);
        bytes_ += size;
        changed_.notify_all();
        return true;
    }

    // Ends the reader's calls until reset(), for this reason. Packets can still be popped. Any thread.
    void close(std::string reason) {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        reason_ = std::move(reason);
        changed_.notify_all();
    }

    // Returns false if closed or interrupted meanwhile.
    bool sleep(double seconds) {
        std::unique_lock lock(mutex_);
        return !changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return ended(); });
    }

    // --- The decoder's thread

    struct Popped {
        Packet packet; // null: closed and empty, or interrupted
        double arrived_s = 0;
        int dropped = 0; // packets left out before this one
    };
    // Blocks until there is a packet.
    Popped pop() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !packets_.empty() || ended(); });
        if (packets_.empty() || interrupted_) return {};
        // Nothing before the newest key frame is needed to decode it.
        size_t first = wait_ ? 0 : packets_.size() - 1;
        while (first > 0 && !(packets_[first].packet->flags & AV_PKT_FLAG_KEY)) --first;
        drop(first);
        Popped popped = std::move(packets_.front());
        packets_.pop_front();
        popped.dropped = std::exchange(dropped_, 0);
        bytes_ -= static_cast<size_t>(popped.packet->size);
        changed_.notify_all();
        return popped;
    }

    size_t count() const {
        const std::lock_guard lock(mutex_);
        return packets_.size();
    }
    std::string reason() const {
        const std::lock_guard lock(mutex_);
        return reason_;
    }

    // --- Any thread

    // Ends all calls, permanently.
    void interrupt() {
        const std::lock_guard lock(mutex_);
        interrupted_ = true;
        changed_.notify_all();
    }

    bool ended() const { return closed_ || interrupted_; }

    static constexpr size_t kMaxPackets = 512, kMaxBytes = size_t{32} << 20, kWaitingPackets = 4;

  private:
    void drop(size_t count) {
        for (; count > 0; --count) {
            bytes_ -= static_cast<size_t>(packets_.front().packet->size);
            packets_.pop_front();
            ++dropped_;
        }
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Popped> packets_;
    size_t bytes_ = 0;
    bool wait_ = false, needsKey_ = false;
    std::atomic<bool> closed_{false}, interrupted_{false}; // changed with the lock held
    int dropped_ = 0;
    std::string reason_;
};

// Delays packets that come faster than their own time stamps (a file on a server, or written to a pipe), but
// never live ones. A token bucket of seconds: it fills as time passes, and each picture takes its duration.
class TokenBucket {
  public:
    // burst_s: seconds that may come at once: a live server may begin with its last few seconds.
    explicit TokenBucket(double burst_s) : max_s_(burst_s), left_s_(burst_s) {}

    // Returns the seconds that a packet stamped stamp_s, which came at now_s, has to wait.
    double wait_s(double stamp_s, double now_s) {
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
    // The last stamp and arrival. NaN gives the first packet no duration; -infinity fills the bucket.
    double stamp_s_ = std::numeric_limits<double>::quiet_NaN();
    double now_s_ = -std::numeric_limits<double>::infinity();
};

} // namespace shoal::media
