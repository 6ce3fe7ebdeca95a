// Real streams over loopback and through a pipe: they stall, break, come back, change, and misbehave.
#include "engine/media/live/LivePlayer.h"

#include "engine/media/VideoFrame.h"
#include "tests/unit/live_server/HttpServer.h"
#include "tests/unit/media/TestFiles.h"

#include <opencv2/imgcodecs.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace shoal::media {
namespace {

using test::HttpServer;

// Returns a grey picture as those of writeGreyVideo().
std::string jpegOf(int number, int width = 64, int height = 32) {
    std::vector<uint8_t> bytes;
    cv::imencode(".jpg", cv::Mat(height, width, CV_8UC3, cv::Scalar::all(kFirstGrey + kGreyStep * number)),
                 bytes);
    return {bytes.begin(), bytes.end()};
}

std::shared_ptr<LiveFeed> feedOf(const std::string& address, const FeedTimeouts& patience = {}) {
    const auto found = liveAddress(address);
    EXPECT_TRUE(found && *found) << address;
    return feedFrom(**found, patience);
}

LiveOptions eager() {
    LiveOptions options;
    options.firstPicture_s = 60; // a busy machine; nothing here takes that long
    options.retryFirst_s = options.retryMax_s = 0.01;
    return options;
}

// Sends picture `number` until the player shows it.
void showBy(HttpServer& server, LivePlayer& player, int number, int width = 64, int height = 32) {
    const std::string jpeg = jpegOf(number, width, height);
    while (numberOf(player.newest()->pixelsBgr) != number) {
        ASSERT_TRUE(server.sendPicture(jpeg));
        std::this_thread::yield();
    }
}

// Picture 0 is shown.
Result<LivePlayer> openedBy(HttpServer& server, const FeedTimeouts& patience = {60, 60}) {
    return LivePlayer::open(feedOf(server.url(), patience), eager(), [&] {
        if (server.accepted() == 0 && (!server.accept() || !server.beginPictures())) return false;
        return server.sendPicture(jpegOf(0));
    });
}

TEST(Stream, PicturesOverHttp) {
    HttpServer server;
    auto player = openedBy(server);
    ASSERT_TRUE(player) << player.error().message();
    for (int i = 1; i < 20; ++i) showBy(server, *player, i);
    EXPECT_EQ(player->notice(), "");
    EXPECT_GE(player->displayFrames(), 1);
    EXPECT_GE(player->age_s(), 0);
}

TEST(Stream, OneThatBreaksIsConnectedAnew) {
    HttpServer server;
    auto player = openedBy(server);
    ASSERT_TRUE(player) << player.error().message();
    for (int round = 1; round <= 3; ++round) {
        round == 2 ? server.hangUp() : server.cut();
        while (player->state() != LiveState::Lost) player->newest();
        EXPECT_NE(player->notice().find("showing its last picture, and trying again"), std::string::npos);
        ASSERT_TRUE(server.accept());
        ASSERT_TRUE(server.beginPictures());
        // Until it is open a picture that is sent is not necessarily shown.
        const std::string jpeg = jpegOf(10 * round);
        while (player->newest(), player->state() != LiveState::Playing) ASSERT_TRUE(server.sendPicture(jpeg));
        EXPECT_EQ(numberOf(player->newest()->pixelsBgr), 10 * round);
        EXPECT_EQ(player->notice(), "");
    }
    EXPECT_EQ(player->counts().losses, 3);
}

TEST(Stream, ASilentOneIsLeftAndConnectedAnew) {
    HttpServer server;
    auto player = openedBy(server, {60, 2});
    ASSERT_TRUE(player) << player.error().message();
    const int shown = numberOf(player->newest()->pixelsBgr);
    ASSERT_TRUE(server.waitForLeave()) << "the connection stands, and nothing comes";
    while (player->state() != LiveState::Lost) player->newest();
    EXPECT_NE(player->notice().find("has sent no picture for 2 s"), std::string::npos) << player->notice();
    EXPECT_EQ(numberOf(player->newest()->pixelsBgr), shown);
    ASSERT_TRUE(server.accept());
    ASSERT_TRUE(server.beginPictures());
    while (player->newest(), player->state() != LiveState::Playing) {
        // Not sent: on a busy machine it may have been silent for too long again.
        ASSERT_TRUE(server.sendPicture(jpegOf(9)) || (server.accept() && server.beginPictures()));
    }
    EXPECT_EQ(numberOf(player->newest()->pixelsBgr), 9);
}

TEST(Stream, ItsSizeMayChangeOnTheWay) {
    HttpServer server;
    auto player = openedBy(server);
    ASSERT_TRUE(player) << player.error().message();
    showBy(server, *player, 3, 128, 64);
    EXPECT_EQ(player->newest()->pixelsBgr.width, 128);
    showBy(server, *player, 4, 35, 35); // odd: the converter's rows end where ours do
    EXPECT_EQ(player->newest()->layout, Layout::TopBottom);
    EXPECT_EQ(player->counts().resized, 2);
}

TEST(Stream, TooLargeAPictureEndsIt) {
    HttpServer server;
    auto player = openedBy(server);
    ASSERT_TRUE(player) << player.error().message();
    ASSERT_TRUE(server.sendPicture(jpegOf(3, 2 * kMaxVideoSide, 16)));
    while (player->state() != LiveState::Lost) player->newest();
    EXPECT_NE(player->notice().find("larger than the limit"), std::string::npos) << player->notice();
}

TEST(Stream, ItCanBeLeftWhileTheServerIsSilent) {
    HttpServer server;
    const FeedTimeouts endless{1e6, 1e6};
    // Neither answered nor accepted, then accepted, then begun, then playing.
    EXPECT_FALSE(LivePlayer::open(feedOf(server.url(), endless), eager(), [] { return false; }));
    EXPECT_FALSE(LivePlayer::open(feedOf(server.url(), endless), eager(), [&] { return !server.accept(); }));
    EXPECT_FALSE(LivePlayer::open(feedOf(server.url(), endless), eager(),
                                  [&] { return !server.accept() || !server.beginPictures(); }));
    HttpServer other;
    auto player = openedBy(other, endless);
    EXPECT_TRUE(player);
}

// Returns the error message for a server's answer.
std::string refusalOf(const std::string& answer) {
    HttpServer server;
    const auto player = LivePlayer::open(feedOf(server.url(), {60, 60}), eager(), [&] {
        if (server.accepted() > 0) return true;
        EXPECT_TRUE(server.accept());
        server.send(answer);
        server.hangUp();
        return true;
    });
    EXPECT_FALSE(player);
    return player ? "" : player.error().message();
}

TEST(Stream, AnAddressThatIsNoStreamIsRefusedWithASentence) {
    const std::string ok = "HTTP/1.1 200 OK\r\nConnection: close\r\n";
    EXPECT_NE(refusalOf("HTTP/1.1 404 Not Found\r\n\r\n").find("404"), std::string::npos);
    EXPECT_NE(refusalOf(ok + "\r\n<html>no video here</html>").find("is no video of a known kind"),
              std::string::npos);
    // The word of a server is not taken for where to look.
    EXPECT_NE(refusalOf(ok + "Content-Type: application/vnd.apple.mpegurl\r\n\r\n#EXTM3U\n#EXT-X-VERSION:3\n"
                             "#EXTINF:1,\nfile:///etc/passwd\n")
                  .find("is no video of a known kind"),
              std::string::npos);
    EXPECT_NE(refusalOf("HTTP/1.1 302 Found\r\nLocation: file:///etc/passwd\r\n\r\n").find("leads elsewhere"),
              std::string::npos);
    EXPECT_FALSE(refusalOf("").empty());
    EXPECT_FALSE(refusalOf(ok + "\r\n" + jpegOf(0).substr(0, 300)).empty());
}

// A file on a server arrives as fast as it is read. It is played at its own rate, whole, and then again.
TEST(Stream, AFileOnAServerPlaysWholeAndBeginsAnew) {
    const TempFolder folder;
    writeGreyVideo(folder / "grey.avi", 12);
    const std::string bytes = readBytes(folder / "grey.avi");
    HttpServer server;
    std::thread serving([&] {
        for (int i = 0; i < 2 && server.accept(); ++i) {
            server.send("HTTP/1.1 200 OK\r\nConnection: close\r\nContent-Length: " +
                        std::to_string(bytes.size()) + "\r\n\r\n" + bytes);
            server.waitForLeave();
        }
    });
    std::atomic<int> made{0};
    std::array<std::atomic<bool>, 12> seen{};
    LiveOptions options = eager();
    options.prepare = [&](const VideoFrame& frame) {
        const int number = numberOf(frame.pixelsBgr);
        if (made < 12) {
            EXPECT_EQ(number, made.load());
        }
        if (number >= 0 && number < 12) seen[static_cast<size_t>(number)] = true;
        ++made;
    };
    auto player = LivePlayer::open(feedOf(server.url(), {60, 60}), std::move(options));
    ASSERT_TRUE(player) << player.error().message();
    while (made < 24) player->newest();
    EXPECT_GE(player->counts().losses, 1);
    { const auto done = std::move(*player); }
    serving.join();
    for (const auto& each : seen) EXPECT_TRUE(each);
}

// A writer of a named pipe, on the test's thread.
class Writer {
  public:
    explicit Writer(const Path& pipe) : descriptor_(::open(pipe.c_str(), O_WRONLY)) {}
    ~Writer() { ::close(descriptor_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    bool write(const std::string& bytes) {
        return ::write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
    }

  private:
    int descriptor_;
};

// Returns more bytes of a picture than FFmpeg needs to recognise the format.
std::string manyOf(int number) {
    std::string bytes;
    for (int i = 0; i < 20; ++i) bytes += jpegOf(number);
    return bytes;
}

TEST(Pipe, WritersComeAndGo) {
    const TempFolder folder;
    const Path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::optional<Writer> writer;
    auto player = LivePlayer::open(feedOf(pipe.string(), {60, 60}), eager(), [&] {
        if (!writer) writer.emplace(pipe); // opening waits for the reader, who waits for pictures
        return writer->write(manyOf(0));
    });
    ASSERT_TRUE(player) << player.error().message();
    EXPECT_EQ(numberOf(player->newest()->pixelsBgr), 0);
    for (int round = 1; round <= 2; ++round) {
        writer.reset();
        while (player->state() != LiveState::Lost) player->newest();
        EXPECT_NE(player->notice().find("The pipe was ended by its sender; showing its last picture"),
                  std::string::npos)
            << player->notice();
        writer.emplace(pipe);
        while (player->newest(), player->state() != LiveState::Playing)
            ASSERT_TRUE(writer->write(manyOf(10 * round)));
        EXPECT_EQ(numberOf(player->newest()->pixelsBgr), 10 * round);
    }
}

TEST(Pipe, ItCanBeLeftBeforeAnybodyWrites) {
    const TempFolder folder;
    const Path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_FALSE(LivePlayer::open(feedOf(pipe.string(), {1e6, 1e6}), eager(), [] { return false; }));
}

} // namespace
} // namespace shoal::media
