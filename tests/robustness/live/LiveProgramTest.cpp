// Runs the whole program with a live video over a network that stalls and breaks.
#include "tests/robustness/program/Program.h"
#include "tests/unit/live_server/HttpServer.h"

#include <opencv2/imgcodecs.hpp>

#include <poll.h>

namespace shoal {
namespace {

namespace fs = std::filesystem;
using media::test::HttpServer;

// A sea whose light swings from left to right, so that neighbours differ.
std::string pictureOf(int number, cv::Size size) {
    cv::Mat picture(size, CV_8UC3);
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x) {
            const double light = 0.5 + 0.5 * std::cos(2 * CV_PI * x / picture.cols - 0.05 * number);
            const double down = 1 - static_cast<double>(y) / picture.rows;
            picture.at<cv::Vec3b>(y, x) =
                cv::Vec3d(60 + 150 * down, 40 + 150 * down * light, 10 + 60 * down * light);
        }
    std::vector<uint8_t> bytes;
    cv::imencode(".jpg", picture, bytes);
    return {bytes.begin(), bytes.end()};
}

class LiveProgram : public tests::Program {
  protected:
    pid_t child_ = -1;

    void TearDown() override {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
    }

    int finish() { return end(std::exchange(child_, -1)); }
    std::string valueOf(const std::string& name) const { return statisticIn("stats.json", name); }
};

// Sends `count` pictures at some thirty a second, or fewer if the client leaves, for which each pause waits.
int stream(HttpServer& server, int first, int count, cv::Size size = {256, 128}) {
    int number = first;
    for (; number < first + count; ++number)
        if (!server.sendPicture(pictureOf(number, size)) || server.waitForLeave(33)) break;
    return number;
}

TEST_F(LiveProgram, APlaythroughPassesWhileItsStreamStallsBreaksAndReturns) {
    const std::string script = tests::sourceFolder().string() + "/tests/robustness/live/stream.toml";
    const std::vector<std::string> play = {
        "play", "--headless", "--no-depth",       "--size",  "64x36",     "--fps",
        "30",   "--hands",    "script:" + script, "--stats", "stats.json"};
    ASSERT_EQ(statusOf(play), 0) << err();
    const std::string undisturbed = valueOf("state_hash");
    ASSERT_EQ(undisturbed.size(), 18u);
    fs::remove(folder_ / "stats.json");

    HttpServer server;
    std::vector<std::string> live = play;
    live.insert(live.end(), {"--video", server.url()});
    child_ = start(live);
    ASSERT_TRUE(server.accept() && server.beginPictures());
    int number = stream(server, 0, 60);
    EXPECT_TRUE(server.waitForLeave()) << "it stalls: the program gives the connection up";
    const std::string lost = "has sent no picture for 4 s; showing its last picture, and trying again";
    while (err().find(lost) == std::string::npos && waitpid(child_, nullptr, WNOHANG) == 0)
        poll(nullptr, 0, 20); // no picture may come again before the program, however slow, has said so
    ASSERT_TRUE(server.accept() && server.beginPictures()) << "it returns";
    number = stream(server, number, 30);
    server.cut();
    ASSERT_TRUE(server.accept() && server.beginPictures()) << "it returns again";
    number = stream(server, number, 30, {99, 49}); // a camera set to another size
    stream(server, number, 1 << 20, {192, 192});
    EXPECT_EQ(finish(), 0) << err();
    EXPECT_EQ(server.accepted(), 3);
    EXPECT_EQ(valueOf("state_hash"), undisturbed) << "what is seen does not enter the simulation";
    EXPECT_EQ(valueOf("losses"), "2");
    EXPECT_EQ(valueOf("resized"), "2");
    EXPECT_GE(std::stoi(valueOf("shown")), 60);
    // A frame may be slower than the stream is lost: LivePlayerTest has the rest.
    const std::string said = err();
    EXPECT_NE(said.find(lost), std::string::npos) << said;
    EXPECT_NE(said.find("pictures come again"), std::string::npos) << said;
}

TEST_F(LiveProgram, AMissingStreamIsOneSentence) {
    const std::vector<std::string> play = {"play", "--headless", "--size", "64x36", "--at", "0.1", "--video"};
    const auto said = [&](const std::string& address, std::vector<std::string> words) {
        words.push_back(address);
        EXPECT_EQ(statusOf(std::move(words)), 1) << address;
        const std::string text = err();
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
        return text;
    };
    EXPECT_NE(said("camera:98", play).find("camera:98: is not there"), std::string::npos);
    EXPECT_NE(said("camera:x", play).find("camera:x"), std::string::npos);
    EXPECT_NE(said("rtmp://host/a", play).find("rtsp, http, https, tcp, udp"), std::string::npos);
    EXPECT_NE(said("http://me:secret@127.0.0.1:1/a", play).find("http://127.0.0.1:1/a: cannot be opened"),
              std::string::npos);
    EXPECT_NE(said("camera:98", {"check"}).find("camera:98: is not there"), std::string::npos);
}

TEST_F(LiveProgram, CheckTellsWhatAStreamIs) {
    HttpServer server;
    child_ = start({"check", server.url()});
    ASSERT_TRUE(server.accept() && server.beginPictures());
    stream(server, 0, 1 << 20);
    EXPECT_EQ(finish(), 0) << err();
    EXPECT_NE(out().find("a live stream of 256x128, lat-long mono"), std::string::npos);
}

// Interrupted by the person while the server is silent: at once, before there is any picture.
TEST_F(LiveProgram, ItEndsWhileTheServerIsSilent) {
    HttpServer server;
    child_ = start({"play", "--headless", "--size", "64x36", "--at", "3600", "--video", server.url()});
    ASSERT_TRUE(server.accept());
    kill(child_, SIGINT);
    EXPECT_NE(finish(), 0);
}

} // namespace
} // namespace shoal
