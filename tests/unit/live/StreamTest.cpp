// Real streams over loopback and through a pipe: they stall, break, come back, change, and misbehave.
#include "engine/media/Ffmpeg.h"
#include "engine/media/VideoFrame.h"
#include "engine/media/live/LivePlayer.h"
#include "tests/unit/live_server/HttpServer.h"
#include "tests/unit/media/TestFiles.h"

extern "C" {
#include <libavutil/opt.h>
}
#include <opencv2/imgcodecs.hpp>

#include <sys/stat.h>
#include <thread>

namespace shoal::media {
namespace {

using test::HttpServer;

// Returns a grey picture as those of writeGreyVideo().
std::string jpegOf(int number, int width = 64, int height = 32) {
    std::vector<uint8_t> bytes;
    cv::imencode(".jpg", greyPicture(number, width, height), bytes);
    return {bytes.begin(), bytes.end()};
}

std::shared_ptr<LiveFeed> feedOf(const std::string& address, const FeedTimeouts& patience = {}) {
    const auto found = liveAddress(address);
    EXPECT_TRUE(found && *found) << address;
    return feedFrom(**found, patience);
}

LiveOptions eager() {
    // A minute for a busy machine; nothing here takes that long.
    return {.firstPicture_s = 60, .retryFirst_s = 0.01, .retryMax_s = 0.01};
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

TEST(Stream, ItsSizeMayChangeOnTheWay) {
    HttpServer server;
    auto player = tests::valueOf(openedBy(server));
    EXPECT_EQ(player.newest()->layout, Layout::Mono);
    showBy(server, player, 3, 128, 64);
    EXPECT_EQ(player.newest()->pixelsBgr.width, 128);
    showBy(server, player, 4, 35, 35); // odd: the converter's rows end where ours do
    EXPECT_EQ(player.newest()->pixelsBgr.height, 35);
    EXPECT_EQ(player.newest()->layout, Layout::TopBottom);
    EXPECT_EQ(player.counts().resized, 2);
    EXPECT_EQ(player.notice(), "");
    EXPECT_GE(player.displayFrames(), 1);
    EXPECT_GE(player.age_s(), 0);
}

TEST(Stream, TooLargeAPictureEndsIt) {
    HttpServer server;
    auto player = tests::valueOf(openedBy(server));
    ASSERT_TRUE(server.sendPicture(jpegOf(3, 2 * kMaxVideoSide, 16)));
    while (player.state() != LiveState::Lost) player.newest();
    EXPECT_NE(player.notice().find("larger than the limit"), std::string::npos) << player.notice();
}

TEST(Stream, ItCanBeLeftWhileTheServerIsSilent) {
    HttpServer server;
    const FeedTimeouts endless{1e6, 1e6};
    // Neither answered nor accepted, then accepted, then begun, then playing.
    const std::function<bool()> stays[] = {[] { return false; }, [&] { return !server.accept(); },
                                           [&] { return !server.accept() || !server.beginPictures(); }};
    for (const auto& stay : stays)
        EXPECT_FALSE(LivePlayer::open(feedOf(server.url(), endless), eager(), stay));
    HttpServer other;
    EXPECT_TRUE(openedBy(other, endless));
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
    LiveOptions options = eager();
    options.prepare = [&](const VideoFrame& frame) {
        if (made < 12) {
            EXPECT_EQ(numberOf(frame.pixelsBgr), made.load());
        }
        ++made;
    };
    auto player = tests::valueOf(LivePlayer::open(feedOf(server.url(), {60, 60}), std::move(options)));
    while (made < 24) player.newest();
    EXPECT_GE(player.counts().losses, 1);
    { const auto done = std::move(player); }
    serving.join();
}

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
    std::ofstream writer;
    const auto write = [&](int number) { return (writer << manyOf(number) << std::flush).good(); };
    auto player = tests::valueOf(LivePlayer::open(feedOf(pipe.string(), {60, 60}), eager(), [&] {
        if (!writer.is_open()) writer.open(pipe); // waits for the reader, who waits for pictures
        return write(0);
    }));
    EXPECT_EQ(numberOf(player.newest()->pixelsBgr), 0);
    for (int round = 1; round <= 2; ++round) {
        writer.close();
        while (player.state() != LiveState::Lost) player.newest();
        EXPECT_THAT(player.notice(),
                    testing::HasSubstr("The pipe was ended by its sender; showing its last picture"));
        writer.open(pipe);
        while (player.newest(), player.state() != LiveState::Playing) ASSERT_TRUE(write(10 * round));
        EXPECT_EQ(numberOf(player.newest()->pixelsBgr), 10 * round);
    }
}

TEST(Pipe, ItCanBeLeftBeforeAnybodyWrites) {
    const TempFolder folder;
    const Path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_FALSE(LivePlayer::open(feedOf(pipe.string(), {1e6, 1e6}), eager(), [] { return false; }));
}

// Tests that a picture is shown when it arrives, not when the next one does: each picture is sent only after
// the one before is shown.

// The value of a header's line, or nothing.
std::string header(const std::string& request, const std::string& name) {
    const size_t at = request.find("\r\n" + name + ": ");
    if (at == std::string::npos) return "";
    const size_t from = at + name.size() + 4;
    return request.substr(from, request.find("\r\n", from) - from);
}

// A server of the part of RTSP (RFC 2326) that a player needs: one client, pictures over the same connection.
class RtspServer {
  public:
    explicit RtspServer(std::string description) : description_(std::move(description)) {}

    std::string url() const { return "rtsp" + server_.url().substr(4); }

    // Drops the last client and blocks until the next has sent all requests and waits for pictures.
    bool accept() {
        if (!server_.accept()) return false;
        for (std::string request = server_.request();; request = server_.nextRequest()) {
            if (request.empty()) return false;
            std::string answer = "RTSP/1.0 200 OK\r\nCSeq: " + header(request, "CSeq") + "\r\nSession: 1\r\n",
                        body;
            if (request.starts_with("OPTIONS")) answer += "Public: DESCRIBE, SETUP, PLAY, TEARDOWN\r\n";
            if (request.starts_with("DESCRIBE")) {
                body = description_ + "a=control:track\r\n";
                answer += "Content-Type: application/sdp\r\nContent-Base: " + url() + "/\r\n";
            }
            if (request.starts_with("SETUP")) answer += "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\n";
            if (!body.empty()) answer += "Content-Length: " + std::to_string(body.size()) + "\r\n";
            if (!server_.send(answer + "\r\n" + body)) return false;
            if (request.starts_with("PLAY")) return true;
        }
    }
    int accepted() const { return server_.accepted(); }

    // Sends RTP and RTCP packets; false if the client has gone.
    bool send(const std::vector<std::string>& packets) {
        for (const std::string& packet : packets) {
            // RTCP's kinds of packets are 200 and above: RFC 5761.
            const bool control = packet.size() > 1 && static_cast<uint8_t>(packet[1]) >= 200 &&
                                 static_cast<uint8_t>(packet[1]) < 212;
            const char head[4] = {'$', control ? '\1' : '\0', static_cast<char>(packet.size() >> 8),
                                  static_cast<char>(packet.size() & 0xff)};
            if (!server_.send(std::string(head, 4) + packet)) return false;
        }
        return true;
    }
    void cut() { server_.cut(); }

  private:
    HttpServer server_; // reads requests, which have the same form
    std::string description_;
};

template <class Byte> int keep(void* pieces, Byte* bytes, int count) { // FFmpeg 7 has them const
    static_cast<std::vector<std::string>*>(pieces)->emplace_back(reinterpret_cast<const char*>(bytes),
                                                                 static_cast<size_t>(count));
    return count;
}

// A stream as a live encoder makes it: H.264 without B-frames.
struct MadeStream {
    std::string description;                      // SDP
    std::vector<std::vector<std::string>> pieces; // [picture][piece]: bytes to send
};

constexpr int kPictures = 240, kLevels = 40;

// Encodes grey pictures of rising levels, 30 a second, every eighth a keyframe. format: FFmpeg's name, such
// as "mpegts" or "rtp". options: "name=value". Returns nothing if FFmpeg lacks the encoder.
std::optional<MadeStream> makeStream(const std::string& format, const std::string& options) {
    constexpr int kWidth = 64, kHeight = 32;
    const AVCodec* kind = avcodec_find_encoder_by_name("libx264");
    if (!kind) return std::nullopt;
    const Codec encoder(avcodec_alloc_context3(kind));
    encoder->width = kWidth;
    encoder->height = kHeight;
    encoder->time_base = {1, 30};
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder->gop_size = 8;
    encoder->thread_count = 1;
    av_opt_set(encoder->priv_data, "preset", "ultrafast", 0);
    av_opt_set(encoder->priv_data, "tune", "zerolatency", 0);
    if (avcodec_open2(encoder.get(), kind, nullptr) < 0) return std::nullopt;

    constexpr int kPiece = 1400; // below a network's largest packet
    std::vector<std::string> pieces;
    AVFormatContext* muxer = nullptr;
    if (avformat_alloc_output_context2(&muxer, nullptr, format.c_str(), "rtp://127.0.0.1:0") < 0)
        return std::nullopt;
    AVIOContext* out = avio_alloc_context(static_cast<uint8_t*>(av_malloc(kPiece)), kPiece, 1, &pieces,
                                          nullptr, keep, nullptr);
    out->max_packet_size = kPiece;
    muxer->pb = out;
    muxer->packet_size = kPiece;
    muxer->flags |= AVFMT_FLAG_FLUSH_PACKETS;
    AVStream* stream = avformat_new_stream(muxer, nullptr);
    avcodec_parameters_from_context(stream->codecpar, encoder.get());
    stream->time_base = encoder->time_base;
    AVDictionary* requests = nullptr;
    av_dict_parse_string(&requests, options.c_str(), "=", ":", 0);
    MadeStream made;
    bool good = avformat_write_header(muxer, &requests) >= 0;
    av_dict_free(&requests);
    char text[2048]{};
    if (good && format == "rtp") av_sdp_create(&muxer, 1, text, sizeof text);
    made.description = text;

    const Frame frame = makeFrame();
    const Packet packet = makePacket();
    frame->width = kWidth;
    frame->height = kHeight;
    frame->format = AV_PIX_FMT_YUV420P;
    av_frame_get_buffer(frame.get(), 0);
    for (int i = 0; good && i < kPictures; ++i) {
        av_frame_make_writable(frame.get());
        const int grey = kFirstGrey + kGreyStep * (i % kLevels), luma = 16 + (219 * grey + 127) / 255;
        std::memset(frame->data[0], luma, static_cast<size_t>(frame->linesize[0]) * kHeight);
        for (const int plane : {1, 2})
            std::memset(frame->data[plane], 128, static_cast<size_t>(frame->linesize[plane]) * (kHeight / 2));
        frame->pts = i;
        good = avcodec_send_frame(encoder.get(), frame.get()) >= 0 &&
               avcodec_receive_packet(encoder.get(), packet.get()) >= 0;
        if (!good) break;
        av_packet_rescale_ts(packet.get(), encoder->time_base, stream->time_base);
        good = av_write_frame(muxer, packet.get()) >= 0;
        av_packet_unref(packet.get());
        av_write_frame(muxer, nullptr);
        avio_flush(out);
        made.pieces.push_back(std::exchange(pieces, {}));
    }
    av_write_trailer(muxer);
    av_freep(&out->buffer);
    avio_context_free(&out);
    muxer->pb = nullptr;
    avformat_free_context(muxer);
    if (!good) return std::nullopt;
    return made;
}

// send(i): sends picture i. Sends one at a time, from `next` on. held: how many pictures
// the format itself holds back.
template <class Send> void eachIsSeenAtOnce(LivePlayer& player, int next, int held, Send&& send) {
    for (; next < kPictures; ++next) {
        ASSERT_TRUE(send(next));
        while (numberOf(player.newest()->pixelsBgr) != (next - held) % kLevels) std::this_thread::yield();
        EXPECT_EQ(player.notice().find("trying again"), std::string::npos);
    }
}

TEST(NoLookAhead, Rtsp) {
    const auto made = makeStream("rtp", "");
    if (!made) GTEST_SKIP() << "FFmpeg has no H.264 encoder here";
    RtspServer server(made->description);
    int next = 0;
    auto player = tests::valueOf(LivePlayer::open(feedOf(server.url(), {60, 60}), eager(), [&] {
        if (server.accepted() == 0 && !server.accept()) return false;
        return next < kPictures / 2 && server.send(made->pieces[next++]);
    }));
    eachIsSeenAtOnce(player, next, 0, [&](int i) { return server.send(made->pieces[i]); });

    // It breaks, and is there again.
    server.cut();
    while (player.state() != LiveState::Lost) player.newest();
    ASSERT_TRUE(server.accept());
    for (int i = 0; player.newest(), player.state() != LiveState::Playing; ++i)
        ASSERT_TRUE(server.send(made->pieces[i % kPictures]));
}

void transportStream(const std::string& options, int held) {
    const auto made = makeStream("mpegts", options);
    if (!made) GTEST_SKIP() << "FFmpeg has no H.264 encoder here";
    HttpServer server;
    const auto send = [&](int i) {
        for (const std::string& piece : made->pieces[i])
            if (!server.send(piece)) return false;
        return true;
    };
    int next = 0;
    auto player = tests::valueOf(LivePlayer::open(feedOf(server.url(), {60, 60}), eager(), [&] {
        if (server.accepted() == 0)
            return server.accept() && server.send("HTTP/1.1 200 OK\r\nConnection: close\r\n\r\n");
        return next < kPictures / 2 && send(next++) && send(next++) && send(next++) && send(next++);
    }));
    eachIsSeenAtOnce(player, next, held, send);
}

TEST(NoLookAhead, TransportStreamThatTellsHowLongItsPicturesAre) {
    transportStream("omit_video_pes_length=0", 0);
}

// A picture of unknown length ends where the next one begins, so that one is held back.
TEST(NoLookAhead, TransportStreamThatDoesNot) { transportStream("omit_video_pes_length=1", 1); }

} // namespace
} // namespace shoal::media
