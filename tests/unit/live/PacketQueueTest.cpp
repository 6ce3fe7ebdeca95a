#include "engine/media/live/PacketQueue.h"

#include <gtest/gtest.h>

#include <thread>

namespace shoal::media {
namespace {

Packet packetOf(int number, bool key, int size = 100) {
    Packet packet = makePacket();
    EXPECT_EQ(av_new_packet(packet.get(), size), 0);
    packet->pts = number;
    packet->flags = key ? AV_PKT_FLAG_KEY : 0;
    return packet;
}

struct Queue : PacketQueue {
    explicit Queue(bool wait = false) { reset(wait); }
    void add(int number, bool key, int size = 100) {
        EXPECT_TRUE(push(*packetOf(number, key, size), number));
    }
    int64_t next() {
        const Popped popped = pop();
        return popped.packet ? popped.packet->pts : -1;
    }
};

TEST(PacketQueue, GoesOnWithTheNewestKeyPicture) {
    Queue queue;
    for (int i = 0; i < 10; ++i) queue.add(i, i % 4 == 0); // 0, 4 and 8
    const auto popped = queue.pop();
    EXPECT_EQ(popped.packet->pts, 8);
    EXPECT_EQ(popped.dropped, 8);
    EXPECT_EQ(popped.arrived_s, 8);
    const auto next = queue.pop();
    EXPECT_EQ(next.dropped, 0);
    EXPECT_EQ(next.packet->pts, 9);
}

TEST(PacketQueue, FullItBeginsAnewWithAKeyPicture) {
    Queue queue;
    const auto maximum = static_cast<int>(PacketQueue::kMaxPackets);
    for (int i = 0; i < maximum + 10; ++i) queue.add(i, i == 0);
    EXPECT_EQ(queue.count(), 0u);
    queue.add(maximum + 10, true);
    queue.add(maximum + 11, false);
    const auto popped = queue.pop();
    EXPECT_EQ(popped.packet->pts, maximum + 10);
    EXPECT_EQ(popped.dropped, maximum + 10);
}

TEST(PacketQueue, BytesAreBounded) {
    Queue queue;
    constexpr int kLarge = 20 << 20;
    for (int i = 0; i < 50; ++i) {
        queue.add(i, i == 0, kLarge);
        EXPECT_LE(queue.count() * kLarge, PacketQueue::kMaxBytes);
    }
}

TEST(PacketQueue, ClosedItGivesWhatItHasThenTellsWhy) {
    Queue queue;
    queue.add(1, true);
    queue.close("is over");
    EXPECT_EQ(queue.next(), 1);
    EXPECT_EQ(queue.next(), -1);
    EXPECT_EQ(queue.reason(), "is over");
    queue.reset(false);
    queue.add(2, true);
    EXPECT_EQ(queue.next(), 2);
}

TEST(PacketQueue, WaitingItDropsNothing) {
    Queue queue(true);
    std::thread writer([&] {
        for (int i = 0; i < 100; ++i) queue.add(i, true);
    });
    for (int i = 0; i < 100; ++i) EXPECT_EQ(queue.next(), i);
    writer.join();
}

TEST(PacketQueue, LeftOrInterruptedNobodyWaits) {
    Queue queue(true);
    std::thread writer([&] {
        while (queue.push(*packetOf(0, true), 0)) {
        }
    });
    queue.stop();
    writer.join();
    EXPECT_FALSE(queue.sleep(1e6));
    Queue empty;
    std::thread reader([&] { EXPECT_FALSE(empty.pop().packet); });
    empty.interrupt();
    reader.join();
}

} // namespace
} // namespace shoal::media
