// Coded pictures on their way from the network to the decoder. What is live is never waited for: where the
// decoder is behind, it goes on with the newest picture that needs none before it.
#pragma once

#include "engine/media/Ffmpeg.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

namespace shoal::media {

class PacketQueue {
  public:
    PacketQueue();

    // Empty again, and open. wait: push() waits for room and drops nothing.
    void reset(bool wait);

    // --- The reader's thread

    // Takes what the packet refers to. False once interrupted.
    bool push(AVPacket& packet, double arrived_s);

    // Nothing more will come; why. What is there can still be popped.
    void close(std::string reason);

    // False if left or interrupted meanwhile.
    bool rest(double seconds);

    // --- The decoder's thread

    struct Popped {
        bool some = false; // else it is closed or interrupted
        double arrived_s = 0;
        int dropped = 0; // packets left out before this one
    };
    // Blocks until there is something.
    Popped pop(Packet& packet);

    void leave(); // the reader is to end; until reset()

    size_t count() const;
    std::string reason() const; // of close()

    // --- Any thread

    void interrupt(); // for good

    static constexpr size_t kMostPackets = 512, kMostBytes = size_t{64} << 20, kWaitingPackets = 4;

  private:
    struct Entry {
        Packet packet;
        double arrived_s = 0;
    };
    Entry& entry(size_t i) { return ring_[(first_ + i) % ring_.size()]; }
    void drop(size_t count);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Entry> ring_;
    size_t first_ = 0, count_ = 0, bytes_ = 0;
    bool wait_ = false, closed_ = false, left_ = false, interrupted_ = false, needsKey_ = false;
    int dropped_ = 0;
    std::string reason_;
};

} // namespace shoal::media
