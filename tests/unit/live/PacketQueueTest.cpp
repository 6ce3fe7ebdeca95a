#include "engine/media/live/PacketQueue.h"
#include "engine/media/live/LivePlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <sys/stat.h>
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
    queue.close("was stopped");
    writer.join();
    EXPECT_FALSE(queue.sleep(1e6));
    Queue empty;
    std::thread reader([&] { EXPECT_FALSE(empty.pop().packet); });
    empty.interrupt();
    reader.join();
}

constexpr double kFrame_s = 1 / 32.0; // exact in binary

TEST(TokenBucket, ASendersClockMayRunAhead) {
    TokenBucket bucket(3);
    constexpr double kFaster = 1.0005; // half of a thousandth: ten times what quartz does
    for (int i = 0; i < 1000000; ++i) ASSERT_EQ(bucket.wait_s(i * kFrame_s * kFaster, i * kFrame_s), 0) << i;
}

TEST(TokenBucket, ABurstPassesWhereItMay) {
    TokenBucket bucket(3);
    for (int i = 0; i <= 96; ++i) EXPECT_EQ(bucket.wait_s(i * kFrame_s, 0), 0) << i;
    EXPECT_GT(bucket.wait_s(97 * kFrame_s, 0), 0);
}

// Waiting as the bucket says plays a file at its own rate, though it arrives as fast as it is read.
TEST(TokenBucket, AFileTakesItsOwnTime) {
    TokenBucket bucket(0.05);
    double now_s = 0;
    constexpr int kFrames = 3200;
    for (int i = 0; i <= kFrames; ++i) now_s += bucket.wait_s(i * kFrame_s, now_s);
    // Ahead by the burst at most, and by the drift that is allowed.
    EXPECT_NEAR(now_s, kFrames * kFrame_s, 0.05 + 1e-3 * kFrames * kFrame_s);
    EXPECT_LE(now_s, kFrames * kFrame_s);
}

TEST(TokenBucket, AfterAPauseNothingIsMadeUp) {
    TokenBucket bucket(0.05);
    double now_s = 0;
    for (int i = 0; i < 32; ++i) now_s += bucket.wait_s(i * kFrame_s, now_s);
    now_s += 60;
    const double before_s = now_s;
    for (int i = 32; i < 64; ++i) now_s += bucket.wait_s(i * kFrame_s, now_s);
    EXPECT_NEAR(now_s - before_s, 1, 0.05 + kFrame_s);
}

TEST(TokenBucket, StampsThatJumpAreNotWaitedFor) {
    TokenBucket bucket(0.05);
    double now_s = 0;
    for (const double stamp_s : {0.0, 5e4, 1.0, 1.0 + kFrame_s, -3e5, 9e9}) {
        EXPECT_LT(bucket.wait_s(stamp_s, now_s), kFrame_s);
        now_s += 1;
    }
}

bool isStream(const Result<std::optional<LiveAddress>>& address) {
    return address && *address && (*address)->camera < 0;
}

TEST(LiveAddress, Cameras) {
    const auto first = liveAddress("camera:0"), last = liveAddress("camera:42");
    ASSERT_TRUE(first && *first && last && *last);
    EXPECT_EQ((*first)->camera, 0);
    EXPECT_EQ((*last)->camera, 42);
    for (const char* none :
         {"camera:", "camera:x", "camera:-1", "camera:100", "camera:1 ", "camera:/dev/video0"})
        EXPECT_FALSE(liveAddress(none)) << none;
}

TEST(LiveAddress, StreamsByTheirSchemesAlone) {
    for (const char* url :
         {"rtsp://host/a", "http://host:1/a?b=c", "https://host/", "tcp://127.0.0.1:9", "udp://@:1"}) {
        const auto address = liveAddress(url);
        ASSERT_TRUE(isStream(address)) << url;
        EXPECT_EQ(std::string((*address)->protocols).find("file"), std::string::npos);
    }
    for (const char* url : {"file:///etc/passwd", "concat://a|b", "ftp://host/a", "HTTP://host/", "data://x",
                            "rtmp://a/b", "subfile,,start,0,end,9,,://x"})
        EXPECT_FALSE(isStream(liveAddress(url))) << url;
    const Error refused = tests::errorOf(liveAddress("rtmp://user:secret@host/a"));
    EXPECT_THAT(refused.reason, testing::HasSubstr("rtsp, http, https, tcp, udp"));
    EXPECT_EQ(refused.message().find("secret"), std::string::npos);
    EXPECT_FALSE(liveAddress("http://" + std::string(5000, 'a')));
}

TEST(LiveAddress, FilesAreFilesAndPipesArePipes) {
    const TempFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    writeBytes(folder / "file", "x");
    const auto pipe = liveAddress((folder / "pipe").string());
    EXPECT_TRUE(isStream(pipe) && (*pipe)->isPipe);
    for (const Path& file :
         {folder / "file", folder / "missing", Path("a.mp4"), Path("camera.mp4"), Path("")})
        EXPECT_FALSE(tests::valueOf(liveAddress(file.string()))) << file;
}

TEST(LiveAddress, PasswordsAreNotShown) {
    EXPECT_EQ(withoutPassword("rtsp://me:secret@host:554/a"), "rtsp://host:554/a");
    EXPECT_EQ(withoutPassword("rtsp://me:sec@ret@host/a@b"), "rtsp://host/a@b");
    EXPECT_EQ(withoutPassword("http://host/a@b"), "http://host/a@b");
    EXPECT_EQ(withoutPassword("camera:0"), "camera:0");
}

TEST(Camera, OneThatIsNotThereSaysSo) {
    if (std::filesystem::exists("/dev/video98")) GTEST_SKIP() << "a machine with 99 cameras";
    EXPECT_EQ(tests::errorOf(LivePlayer::open(feedFrom({.camera = 98}))).message(),
              "camera:98: is not there; `shoal devices` lists the cameras that are");
    EXPECT_FALSE(listCameras().contains(98));
}

} // namespace
} // namespace shoal::media
