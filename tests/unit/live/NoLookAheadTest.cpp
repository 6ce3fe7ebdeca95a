// Tests that a picture is shown when it arrives, not when the next one does: each picture is sent only after
// the one before is shown.
#include "engine/media/live/LivePlayer.h"

#include "tests/unit/live_server/HttpServer.h"
#include "tests/unit/live_server/MadeStream.h"
#include "tests/unit/live_server/RtspServer.h"
#include "tests/unit/media/TestFiles.h"

#include <chrono>
#include <thread>

namespace shoal::media {
namespace {

using namespace test;

constexpr int kPictures = 240, kLevels = 40;

std::vector<int> greys() {
    std::vector<int> levels;
    for (int i = 0; i < kPictures; ++i) levels.push_back(kFirstGrey + kGreyStep * (i % kLevels));
    return levels;
}

// send(i): picture i, over the line. Begins with `first` of them; then one at a time. held: how many pictures
// the format itself holds back.
template <class Send> void eachIsSeenAtOnce(LivePlayer& player, int next, int held, Send&& send) {
    for (; next < kPictures; ++next) {
        ASSERT_TRUE(send(next));
        while (numberOf(player.newest()->pixelsBgr) != (next - held) % kLevels) std::this_thread::yield();
        EXPECT_EQ(player.notice().find("trying again"), std::string::npos);
    }
}

std::shared_ptr<LiveFeed> patientFeed(const std::string& address) {
    return feedFrom(**liveAddress(address), {60, 60});
}

LiveOptions patient() {
    LiveOptions options;
    options.firstPicture_s = 60;
    return options;
}

TEST(NoLookAhead, Rtsp) {
    const auto made = makeStream("rtp", "", greys());
    if (!made) GTEST_SKIP() << "FFmpeg has no H.264 encoder here";
    RtspServer server(made->description);
    int next = 0;
    auto player = LivePlayer::open(patientFeed(server.url()), patient(), [&] {
        if (server.accepted() == 0 && !server.accept()) return false;
        return next < kPictures / 2 && server.send(made->pieces[static_cast<size_t>(next++)]);
    });
    ASSERT_TRUE(player) << player.error().message();
    eachIsSeenAtOnce(*player, next, 0,
                     [&](int i) { return server.send(made->pieces[static_cast<size_t>(i)]); });

    // It breaks, and is there again.
    server.cut();
    while (player->state() != LiveState::Lost) player->newest();
    ASSERT_TRUE(server.accept());
    for (int i = 0; player->newest(), player->state() != LiveState::Playing; ++i)
        ASSERT_TRUE(server.send(made->pieces[static_cast<size_t>(i % kPictures)]));
}

void transportStream(const std::string& options, int held) {
    const auto made = makeStream("mpegts", options, greys());
    if (!made) GTEST_SKIP() << "FFmpeg has no H.264 encoder here";
    HttpServer server;
    const auto send = [&](int i) {
        for (const std::string& piece : made->pieces[static_cast<size_t>(i)])
            if (!server.send(piece)) return false;
        return true;
    };
    int next = 0;
    auto player = LivePlayer::open(patientFeed(server.url()), patient(), [&] {
        if (server.accepted() == 0)
            return server.accept() && server.send("HTTP/1.1 200 OK\r\nConnection: close\r\n\r\n");
        return next < kPictures / 2 && send(next++) && send(next++) && send(next++) && send(next++);
    });
    ASSERT_TRUE(player) << player.error().message();
    eachIsSeenAtOnce(*player, next, held, send);
}

TEST(NoLookAhead, TransportStreamThatTellsHowLongItsPicturesAre) {
    transportStream("omit_video_pes_length=0", 0);
}

// A picture of unknown length ends where the next one begins, so that one is held back.
TEST(NoLookAhead, TransportStreamThatDoesNot) { transportStream("omit_video_pes_length=1", 1); }

} // namespace
} // namespace shoal::media
