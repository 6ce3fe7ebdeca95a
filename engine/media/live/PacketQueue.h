// Bounded queue of coded pictures between the reader's thread and the decoder's. Where the decoder is behind
// a live stream, packets before the newest key frame are dropped.
#pragma once

#include "engine/media/Ffmpeg.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>

namespace shoal::media {

class PacketQueue {
  public:
    // Empties and opens it. wait: push() waits for room and drops nothing.
    void reset(bool wait);

    // --- The reader's thread

    // Takes over the packet's data. False once stopped or interrupted.
    bool push(AVPacket& packet, double arrived_s);

    // No more packets will come, for this reason. Those in the queue can still be popped.
    void close(std::string reason);

    // False if stopped or interrupted meanwhile.
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

    void interrupt(); // for good

    static constexpr size_t kMaxPackets = 512, kMaxBytes = size_t{64} << 20, kWaitingPackets = 4;

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

} // namespace shoal::media
