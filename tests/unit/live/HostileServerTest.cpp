// Malicious servers: the player leaves them soon, and they cannot make it open another file or server.
#include "engine/media/live/LivePlayer.h"
#include "tests/Test.h"
#include "tests/unit/live_server/HttpServer.h"

#include <atomic>
#include <thread>

namespace shoal::media {
namespace {

using test::HttpServer;

const std::string kOk = "HTTP/1.1 200 OK\r\nConnection: close\r\n";

#if defined(__SANITIZE_ADDRESS__)
constexpr double kMax_MB = 2 * 256; // the sanitizer keeps 256 MB of what has been freed
#else
constexpr double kMax_MB = 256;
#endif

double peakMemory_MB() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1e3;
    return 0;
}

// Returns the error message for a server that runs `serve` once a client has asked.
template <class Serve> std::string refusalOf(HttpServer& server, const std::string& scheme, Serve serve) {
    const auto address = liveAddress(scheme + server.url().substr(4));
    if (!address || !*address) return "no address";
    std::thread serving([&] {
        if (server.accept(scheme != "tcp")) serve();
        server.hangUp();
    });
    const auto player = LivePlayer::open(feedFrom(**address, {20, 20}), {.firstPicture_s = 60});
    serving.join();
    return player ? "" : player.error().message();
}

// The word of a server is not taken for where to look.
TEST(HostileServer, AnAnswerThatIsNoStreamIsRefusedWithASentence) {
    const std::pair<std::string, const char*> answers[] = {
        {"HTTP/1.1 404 Not Found\r\n\r\n", "404"},
        {"HTTP/1.1 302 Found\r\nLocation: file:///etc/passwd\r\n\r\n", "leads elsewhere"},
        {kOk + "\r\n<html>no video here</html>", "is no video of a known kind"},
        {kOk + "Content-Type: application/vnd.apple.mpegurl\r\n\r\n#EXTM3U\n#EXT-X-VERSION:3\n#EXTINF:1,\n"
               "file:///etc/passwd\n",
         "is no video of a known kind"},
        {kOk + "\r\n" + std::string("\xff\xd8\xff\xe0\0\x10JFIF\0", 11) + std::string(280, 'x'),
         ": "}, // a picture that is cut short
        {"", ": "},
    };
    for (const auto& [answer, sentence] : answers) {
        HttpServer server;
        EXPECT_THAT(refusalOf(server, "http", [&] { server.send(answer); }), testing::HasSubstr(sentence))
            << answer;
    }
}

TEST(HostileServer, RedirectsLeadNowhere) {
    HttpServer other;
    std::string elsewhere = other.url("/secret");
    for (const char* scheme : {"http", "rtsp", "concat", "file"}) {
        const std::string to = scheme + elsewhere.substr(elsewhere.find(':'));
        for (const std::string from : {"http", "rtsp"}) {
            HttpServer server;
            const std::string answer =
                (from == "http" ? "HTTP/1.1 302 Found\r\n" : "RTSP/1.0 302 Found\r\nCSeq: 1\r\n") +
                ("Location: " + to + "\r\n\r\n");
            EXPECT_NE(refusalOf(server, from, [&] { server.send(answer); }), "") << from << " to " << to;
            EXPECT_FALSE(server.wasTried()) << "nor is it asked itself again";
            EXPECT_FALSE(other.wasTried()) << from << " to " << to;
        }
    }
}

TEST(HostileServer, PlayListsAndDescriptionsOpenNothing) {
    HttpServer other;
    const std::string there = other.url("/secret.ts");
    const std::string port = there.substr(17, there.find('/', 17) - 17);
    const std::pair<std::string, std::string> lists[] = {
        {"application/vnd.apple.mpegurl", "#EXTM3U\n#EXT-X-VERSION:3\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\n" +
                                              there + "\n#EXTINF:1,\nfile:///etc/passwd\n"},
        {"application/dash+xml",
         "<?xml version=\"1.0\"?><MPD xmlns=\"urn:mpeg:dash:schema:mpd:2011\" type=\"static\"><Period>"
         "<AdaptationSet mimeType=\"video/mp4\"><Representation id=\"1\" bandwidth=\"1\"><BaseURL>" +
             there + "</BaseURL></Representation></AdaptationSet></Period></MPD>"},
        {"text/plain", "ffconcat version 1.0\nfile " + there + "\nfile /etc/passwd\n"},
        {"application/sdp", "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=x\r\nc=IN IP4 127.0.0.1\r\nt=0 0\r\n"
                            "m=video " +
                                port + " RTP/AVP 26\r\n"},
    };
    for (const auto& [type, text] : lists) {
        HttpServer server;
        const std::string said = refusalOf(
            server, "http", [&] { server.send(kOk + "Content-Type: " + type + "\r\n\r\n" + text); });
        EXPECT_NE(said, "") << type;
        EXPECT_FALSE(other.wasTried()) << type;
    }
}

// A picture that claims two gigabytes; headers and data without an end.
TEST(HostileServer, AnEndlessAnswerIsLeftAndTakesNoMemory) {
    const double before_MB = peakMemory_MB();
    const std::string parts = "Content-Type: multipart/x-mixed-replace; boundary=b\r\n\r\n";
    const std::string heads[] = {
        kOk + parts + "--b\r\nContent-Type: image/jpeg\r\nContent-Length: 2147483000\r\n\r\n\xff\xd8",
        kOk + parts + "--b\r\nContent-Type: image/jpeg\r\n\r\n\xff\xd8",
        kOk + "Content-Type: video/mp2t\r\n\r\n",
        kOk + "Content-Type: video/x-matroska\r\n\r\n\x1a\x45\xdf\xa3\x01\xff\xff\xff\xff\xff\xff\xff",
        kOk + "X-Endless: ",
    };
    const std::string more(1 << 20, 'x');
    for (const std::string& head : heads) {
        HttpServer server;
        int sent_MB = 0;
        const std::string said = refusalOf(server, "http", [&] {
            bool there = server.send(head);
            for (; there && sent_MB < 512; ++sent_MB) there = server.send(more);
        });
        EXPECT_NE(said, "");
        if (!head.ends_with(": ")) { // a line of a header is left by its time, and not kept
            EXPECT_LT(sent_MB, 100) << "of " << head.substr(40);
        }
    }
    EXPECT_LT(peakMemory_MB() - before_MB, kMax_MB);
}

TEST(HostileServer, RubbishByTcpAndUdpIsLeftToo) {
    const double before_MB = peakMemory_MB();
    {
        HttpServer server;
        int sent_MB = 0;
        const std::string more(1 << 20, 'G'); // each byte may begin a packet of a transport stream
        const std::string said = refusalOf(server, "tcp", [&] {
            while (sent_MB < 512 && server.send(more)) ++sent_MB;
        });
        EXPECT_NE(said, "");
        EXPECT_LT(sent_MB, 100);
    }
    std::atomic<bool> over{false};
    const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to{
        .sin_family = AF_INET, .sin_port = 0, .sin_addr = {htonl(INADDR_LOOPBACK)}, .sin_zero = {}};
    socklen_t size = sizeof to;
    { // a port that is free now
        const int finder = ::socket(AF_INET, SOCK_DGRAM, 0);
        ASSERT_EQ(::bind(finder, reinterpret_cast<sockaddr*>(&to), size), 0);
        ASSERT_EQ(::getsockname(finder, reinterpret_cast<sockaddr*>(&to), &size), 0);
        ::close(finder);
    }
    std::thread sending([&] {
        const std::string packet(1400, 'G');
        while (!over)
            ::sendto(socket, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&to), size);
    });
    const auto address = liveAddress("udp://127.0.0.1:" + std::to_string(ntohs(to.sin_port)));
    const auto player = LivePlayer::open(feedFrom(**address, {20, 20}), {.firstPicture_s = 60});
    over = true;
    sending.join();
    ::close(socket);
    EXPECT_FALSE(player);
    EXPECT_LT(peakMemory_MB() - before_MB, kMax_MB);
}

} // namespace
} // namespace shoal::media
