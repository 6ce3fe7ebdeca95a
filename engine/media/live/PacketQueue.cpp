#include "engine/media/live/PacketQueue.h"

#include <chrono>
#include <utility>

namespace shoal::media {

void PacketQueue::reset(bool wait) {
    const std::lock_guard lock(mutex_);
    drop(packets_.size());
    wait_ = wait;
    closed_ = stopped_ = needsKey_ = false;
    dropped_ = 0;
}

void PacketQueue::drop(size_t count) {
    for (; count > 0; --count) {
        bytes_ -= static_cast<size_t>(packets_.front().packet->size);
        packets_.pop_front();
        ++dropped_;
    }
}

bool PacketQueue::push(AVPacket& packet, double arrived_s) {
    std::unique_lock lock(mutex_);
    if (wait_)
        changed_.wait(lock, [&] { return interrupted_ || stopped_ || packets_.size() < kWaitingPackets; });
    if (interrupted_ || stopped_) return false;
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

PacketQueue::Popped PacketQueue::pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !packets_.empty() || closed_ || interrupted_; });
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

size_t PacketQueue::count() const {
    const std::lock_guard lock(mutex_);
    return packets_.size();
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
