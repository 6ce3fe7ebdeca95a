#include "engine/media/live/PacketQueue.h"

#include <chrono>

namespace shoal::media {

PacketQueue::PacketQueue() : ring_(kMaxPackets) {
    for (Entry& each : ring_) each.packet = makePacket();
}

void PacketQueue::reset(bool wait) {
    const std::lock_guard lock(mutex_);
    drop(count_);
    wait_ = wait;
    closed_ = stopped_ = needsKey_ = false;
    dropped_ = 0;
}

void PacketQueue::drop(size_t count) {
    for (size_t i = 0; i < count; ++i) {
        Entry& oldest = entry(0);
        bytes_ -= static_cast<size_t>(oldest.packet->size);
        av_packet_unref(oldest.packet.get());
        first_ = (first_ + 1) % ring_.size();
        --count_;
        ++dropped_;
    }
}

bool PacketQueue::push(AVPacket& packet, double arrived_s) {
    std::unique_lock lock(mutex_);
    if (wait_) changed_.wait(lock, [&] { return interrupted_ || stopped_ || count_ < kWaitingPackets; });
    if (interrupted_ || stopped_) return false;
    const bool key = packet.flags & AV_PKT_FLAG_KEY;
    const auto size = static_cast<size_t>(packet.size);
    if (!wait_ && (count_ == ring_.size() || bytes_ + size > kMaxBytes)) {
        drop(count_);
        needsKey_ = true;
    }
    if (needsKey_ && !key) {
        ++dropped_;
        av_packet_unref(&packet);
        return true;
    }
    needsKey_ = false;
    Entry& free = entry(count_);
    av_packet_move_ref(free.packet.get(), &packet);
    free.arrived_s = arrived_s;
    bytes_ += size;
    ++count_;
    changed_.notify_all();
    return true;
}

void PacketQueue::close(std::string reason) {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    reason_ = std::move(reason);
    changed_.notify_all();
}

bool PacketQueue::sleep(double seconds) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                              [&] { return interrupted_ || stopped_; });
}

PacketQueue::Popped PacketQueue::pop(Packet& packet) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return count_ > 0 || closed_ || interrupted_; });
    if (count_ == 0 || interrupted_) return {};
    // Nothing before the newest key frame is needed to decode it.
    if (!wait_)
        for (size_t i = count_ - 1; i > 0; --i)
            if (entry(i).packet->flags & AV_PKT_FLAG_KEY) {
                drop(i);
                break;
            }
    Entry& oldest = entry(0);
    const Popped popped{true, oldest.arrived_s, dropped_};
    dropped_ = 0;
    bytes_ -= static_cast<size_t>(oldest.packet->size);
    av_packet_unref(packet.get());
    av_packet_move_ref(packet.get(), oldest.packet.get());
    first_ = (first_ + 1) % ring_.size();
    --count_;
    changed_.notify_all();
    return popped;
}

size_t PacketQueue::count() const {
    const std::lock_guard lock(mutex_);
    return count_;
}

std::string PacketQueue::reason() const {
    const std::lock_guard lock(mutex_);
    return reason_;
}

void PacketQueue::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

void PacketQueue::interrupt() {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    changed_.notify_all();
}

} // namespace shoal::media
