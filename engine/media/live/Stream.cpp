#include "engine/core/ThreadPool.h"
#include "engine/media/Decoder.h"
#include "engine/media/live/LiveFeed.h"
#include "engine/media/live/PacketQueue.h"

#include <fmt/core.h>

#include <fcntl.h>
#include <memory>
#include <poll.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace shoal::media {

namespace {

// Containers of video; no playlists, which name further addresses.
constexpr const char* kFormats =
    "mpegts,mov,mp4,matroska,webm,avi,flv,live_flv,ogg,mpeg,mpjpeg,mjpeg,h264,hevc,ivf,nut,rtsp";

std::string textOf(int error) {
    char text[AV_ERROR_MAX_STRING_SIZE]{};
    return av_make_error_string(text, sizeof text, error);
}

// Greatest size of a picture: some 250 MB for the pictures that are decoded and shown at once.
constexpr int64_t kMaxLivePixels = int64_t{4096} * 4096;
// Seconds of video that may come at once before packets wait for their time stamps.
constexpr double kLiveBurst_s = 3, kStoredBurst_s = 0.05;
// While catching up, a picture is shown at least this often.
constexpr double kMaxHidden_s = 0.25;
// This many waiting packets mean that the decoder is behind; fewer are network jitter.
constexpr size_t kBehind = 3;
// More bytes than this without a picture are not video: a sender may claim any size.
constexpr int64_t kMaxBytesBetween = int64_t{32} << 20;

// A stream or pipe. One thread reads packets as they come, so that none wait in the network; another decodes.
class Stream final : public LiveFeed {
  public:
    Stream(const LiveAddress& address, const FeedTimeouts& timeouts)
        : LiveFeed(address.isPipe ? address.place : withoutPassword(address.place),
                   address.isPipe ? "pipe" : "stream"),
          address_(address), timeouts_(timeouts) {
        setUpDecoders();
    }
    ~Stream() override {
        stopReader();
        format_.reset(); // before the members that watch() reads
        if (pipe_ >= 0) ::close(pipe_);
    }

    Status open() override {
        stopReader();
        if (Status connected = connect(); !connected) return connected;
        const auto threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
        const Status opened = decoder_.open(video(), FrameThreading::None, threads, kMaxLivePixels);
        if (!opened) return opened;
        queue_.reset(stored_);
        lastShown_s_ = liveNow_s();
        ended_ = false;
        reader_ = std::thread([this] { readPackets(); });
        return Done{};
    }

    Result<int64_t> read(ImageRgb8& bgr, VideoFrame& frame) override {
        int64_t skipped = 0;
        double began_s = liveNow_s();
        for (;;) {
            while (decoder_.receive()) {
                // The picture is outdated: it was decoded only because later pictures refer to it.
                if (queue_.count() > 0 && !stored_ && liveNow_s() - lastShown_s_ < kMaxHidden_s) {
                    ++skipped;
                    continue;
                }
                if (Status converted = decoder_.convert(bgr, &frame.radianceLin); !converted)
                    return converted.error();
                frame.arrived_s = static_cast<double>(decoder_.frame().pts) * 1e-6;
                frame.chromaTexels = decoder_.chromaTexels();
                lastShown_s_ = liveNow_s();
                frame.decode_ms = 1e3 * (lastShown_s_ - began_s);
                return skipped;
            }
            if (ended_) return Error{"", queue_.reason()};
            const PacketQueue::Popped popped = queue_.pop();
            began_s = liveNow_s();
            if (popped.dropped > 0) decoder_.flush();
            skipped += popped.dropped;
            ended_ = !popped.packet; // reported once the decoder is drained
            const bool hurry = !stored_ && queue_.count() >= kBehind;
            // The stamp carries the packet's time of arrival, microseconds: the decoder returns it with the
            // picture, in whatever order pictures come.
            if (popped.packet) popped.packet->pts = static_cast<int64_t>(popped.arrived_s * 1e6);
            decoder_.send(popped.packet.get(), hurry);
        }
    }

    void interrupt() override { queue_.interrupt(); }

  private:
    bool givesUp() const { return queue_.ended() || tooMuch_ || liveNow_s() > deadline_s_; }

    // Called by FFmpeg while it waits: returns whether to give up.
    static int watch(void* self) {
        auto& stream = *static_cast<Stream*>(self);
        if (AVFormatContext* format = stream.format_.get()) {
            stream.tooMuch_ |= stream.bytesRead() - stream.packetBegan_ > kMaxBytesBetween;
            // The connection being made is the only one: an RTSP server cannot redirect us to another.
            const bool isRtsp = !stream.address_.isPipe && stream.address_.place.starts_with("rtsp");
            if (isRtsp && !std::exchange(stream.closed_, true))
                av_opt_set(format, "protocol_whitelist", "none", 0);
        }
        return stream.givesUp();
    }

    int64_t bytesRead() const { return format_ && format_->pb ? format_->pb->bytes_read : 0; }
    const AVStream& video() const { return *format_->streams[stream_]; }

    // Opens a pipe for its present writer, or the next.
    Status openPipe(const Path& file) {
        // A new writer must not find the pipe without readers, so it opens before the old one is closed. It
        // opens each time, because after a writer has closed the old descriptor tells only the end of file.
        const int opened = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        if (pipe_ >= 0) ::close(pipe_);
        pipe_ = opened;
        struct stat found {};
        if (pipe_ < 0 || fstat(pipe_, &found) != 0 || !S_ISFIFO(found.st_mode))
            return Error{"", "cannot be opened for reading"};
        // Waits for the first writer, because before it comes FFmpeg would find the end of the file. If none
        // comes in time openFormat() says so.
        constexpr int kPollInterval_ms = 100;
        pollfd waiting{pipe_, POLLIN, 0};
        while (!givesUp() && poll(&waiting, 1, kPollInterval_ms) <= 0) {
        }
        return Done{};
    }

    // Opens format_ and finds its streams.
    Status openFormat() {
        AVFormatContext* format = avformat_alloc_context();
        if (!format) return Error{"", "cannot be opened: there is no memory"};
        format->interrupt_callback = {watch, this};
        format_.reset(format); // which watch() reads
        const std::string opened = address_.isPipe ? "pipe:" + std::to_string(pipe_) : address_.place;
        const std::pair<const char*, const char*> wanted[] = {{"format_whitelist", kFormats},
                                                              {"protocol_whitelist", address_.protocols},
                                                              {"user_agent", "Shoal"},
                                                              {"rtsp_transport", "tcp"},
                                                              {"max_redirects", "0"}};
        AVDictionary* options = nullptr;
        for (const auto& [option, value] : wanted) av_dict_set(&options, option, value, 0);
        format->max_analyze_duration = AV_TIME_BASE;
        format->fps_probe_size = 0; // live frames arrive slowly: do not wait for several
        int error = avformat_open_input(&format, opened.c_str(), nullptr, &options);
        av_dict_free(&options);
        if (!format) (void)format_.release(); // freed by the failure
        if (error >= 0) {
            // FFmpeg's parser ends a picture at the beginning of the next, which delays each by one. In these
            // formats packets are pictures already; a parser of our own finds the key frames.
            const std::string_view container = format->iformat->name;
            if (container == "mpegts" || container == "rtsp")
                format->flags |= AVFMT_FLAG_NOPARSE | AVFMT_FLAG_NOFILLIN;
            std::vector<AVDictionary*> decoders(format->nb_streams); // options of those that find parameters
            for (AVDictionary*& each : decoders) av_dict_set_int(&each, "max_pixels", kMaxLivePixels, 0);
            error = avformat_find_stream_info(format, decoders.data());
            for (AVDictionary*& each : decoders) av_dict_free(&each);
        }
        if (error >= 0) return Done{};
        format_.reset();
        if (tooMuch_) return Error{"", "sends too much for one picture"};
        if (!queue_.ended() && liveNow_s() > deadline_s_)
            return Error{"", fmt::format("did not answer within {:.3g} s", timeouts_.open_s)};
        if (error == AVERROR_INVALIDDATA || error == AVERROR(EIO) || error == AVERROR_EOF)
            return Error{
                "", "is no video of a known kind, breaks off before its first picture, or leads elsewhere"};
        return Error{"", "cannot be opened: " + textOf(error)};
    }

    void markKeyFrame(AVPacket& packet) {
        uint8_t* bytes = nullptr;
        int size = 0;
        av_parser_parse2(parser_.get(), parsed_.get(), &bytes, &size, packet.data, packet.size, packet.pts,
                         packet.dts, packet.pos);
        const bool key =
            parser_->key_frame == 1 || (parser_->key_frame < 0 && parser_->pict_type == AV_PICTURE_TYPE_I);
        packet.flags = key ? packet.flags | AV_PKT_FLAG_KEY : packet.flags & ~AV_PKT_FLAG_KEY;
    }

    Status connect() {
        format_.reset();
        stream_ = -1;
        queue_.reset(false);
        packetBegan_ = 0;
        tooMuch_ = closed_ = false;
        deadline_s_ = liveNow_s() + timeouts_.open_s;
        if (address_.isPipe)
            if (Status opened = openPipe(address_.place); !opened) return opened;
        if (Status opened = openFormat(); !opened) return opened;
        stream_ = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
        if (stream_ < 0) return Error{"", "has no pictures"};
        keepOnly(*format_, stream_);
        const AVCodecParameters& coded = *video().codecpar;
        if (int64_t{coded.width} * coded.height > kMaxLivePixels)
            return Error{"", fmt::format("its picture of {}x{} pixels is larger than is played live",
                                         coded.width, coded.height)};
        if (coded.width > 0)
            if (Status playable = checkPictureSize(coded.width, coded.height); !playable) return playable;
        parser_.reset(format_->flags & AVFMT_FLAG_NOPARSE ? av_parser_init(coded.codec_id) : nullptr);
        parsed_.reset(avcodec_alloc_context3(nullptr));
        if (parser_ && parsed_ && avcodec_parameters_to_context(parsed_.get(), &coded) >= 0)
            parser_->flags |= PARSER_FLAG_COMPLETE_FRAMES;
        else
            parser_.reset();
        stored_ = format_->pb && avio_size(format_->pb) > 0;
        return Done{};
    }

    // Blocks until the next video packet. The error says why there is none.
    Status readPacket(AVPacket& packet) {
        deadline_s_ = liveNow_s() + timeouts_.silence_s;
        for (;;) {
            av_packet_unref(&packet);
            packetBegan_ = bytesRead();
            const int error = av_read_frame(format_.get(), &packet);
            if (error >= 0 && packet.stream_index == stream_) {
                if (parser_) markKeyFrame(packet);
                return Done{};
            }
            if (tooMuch_) return Error{"", "sends too much for one picture"};
            if (givesUp() || error == AVERROR_EXIT)
                return Error{"", fmt::format("has sent no picture for {:.3g} s", timeouts_.silence_s)};
            if (error == AVERROR_EOF) return Error{"", stored_ ? "is over" : "was ended by its sender"};
            if (error == AVERROR(EAGAIN))
                av_usleep(5000);
            else if (error < 0)
                return Error{"", "broke off: " + textOf(error)};
        }
    }

    void readPackets() {
        lowerThreadPriority();
        const Packet packet = makePacket();
        TokenBucket bucket(stored_ ? kStoredBurst_s : kLiveBurst_s);
        const double unit_s = av_q2d(video().time_base);
        const bool stamped =
            !(format_->iformat->flags & AVFMT_NOTIMESTAMPS); // else FFmpeg invents the stamps
        for (;;) {
            if (Status read = readPacket(*packet); !read) return queue_.close(read.error().reason);
            if (stamped && packet->dts != AV_NOPTS_VALUE) {
                const double wait_s = bucket.wait_s(static_cast<double>(packet->dts) * unit_s, liveNow_s());
                if (wait_s > 0 && !queue_.sleep(wait_s)) break;
            }
            if (!queue_.push(*packet, liveNow_s())) break;
        }
        queue_.close("was stopped");
    }

    void stopReader() {
        if (!reader_.joinable()) return;
        queue_.close("was stopped");
        reader_.join();
    }

    // Used by the thread that opens, then by the reader's:
    LiveAddress address_;
    FeedTimeouts timeouts_;
    int pipe_ = -1; // descriptor of a pipe
    Input format_;  // open, or being opened
    int stream_ = -1;
    bool closed_ = false;     // closed to further connections
    int64_t packetBegan_ = 0; // bytes received before the packet
    bool tooMuch_ = false;    // more than kMaxBytesBetween have come
    std::unique_ptr<AVCodecParserContext, void (*)(AVCodecParserContext*)> parser_{nullptr, av_parser_close};
    Codec parsed_;
    double deadline_s_ = 0;

    bool stored_ = false; // a file on a server, of known length: it sends as fast as it is read
    PacketQueue queue_;
    std::thread reader_;

    // Used by the decoder's thread:
    Decoder decoder_;
    double lastShown_s_ = 0;
    bool ended_ = false;
};

} // namespace

std::shared_ptr<LiveFeed> streamFeed(const LiveAddress& address, const FeedTimeouts& timeouts) {
    return std::make_shared<Stream>(address, timeouts);
}

} // namespace shoal::media
