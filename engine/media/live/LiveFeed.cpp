#include "engine/media/live/LiveFeed.h"

#include "engine/core/Threads.h"
#include "engine/media/PictureDecoder.h"
#include "engine/media/live/Camera.h"
#include "engine/media/live/PacketQueue.h"
#include "engine/media/live/StreamInput.h"
#include "engine/media/live/Timing.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

namespace shoal::media {

namespace {

// Burst that may come at once before packets are held to their own time stamps.
constexpr double kLiveBurst_s = 3, kStoredBurst_s = 0.05;
// While catching up, a picture is shown at least this often.
constexpr double kMaxHidden_s = 0.25;
// So many waiting packets mean that the decoder is behind; fewer are network jitter.
constexpr size_t kBehind = 3;

// A stream or pipe. One thread reads packets as they come, so that none wait in the network; another decodes.
class Stream {
  public:
    Stream(const LiveAddress& address, const FeedTimeouts& timeouts) : input_(address, timeouts) {}
    ~Stream() { stopReader(); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    Status open() {
        stopReader();
        if (Status opened = input_.open(); !opened) return opened;
        decoder_.emplace();
        const AVStream& picture = input_.video();
        const auto threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
        if (Status opened =
                decoder_->open(*picture.codecpar, picture.time_base, FrameThreading::None, threads);
            !opened)
            return opened;
        queue_.reset(input_.stored());
        lastShown_s_ = liveNow_s();
        ended_ = false;
        reader_ = std::thread([this] { readPackets(); });
        return Done{};
    }

    Result<LivePicture> read(ImageRgb8& bgr) {
        LivePicture picture;
        double began_s = liveNow_s();
        for (;;) {
            while (decoder_->receive()) {
                // Outdated: decoded only because later pictures refer to it.
                if (queue_.count() > 0 && !input_.stored() && liveNow_s() - lastShown_s_ < kMaxHidden_s) {
                    ++picture.passedOver;
                    continue;
                }
                if (Status converted = decoder_->convert(bgr); !converted) return converted.error();
                picture.arrived_s = decoder_->arrived_s();
                lastShown_s_ = liveNow_s();
                picture.decode_ms = 1e3 * (lastShown_s_ - began_s);
                return picture;
            }
            if (ended_) return Error{"", queue_.reason()};
            const PacketQueue::Popped popped = queue_.pop(packet_);
            began_s = liveNow_s();
            if (popped.dropped > 0) decoder_->flush();
            picture.passedOver += popped.dropped;
            ended_ = !popped.some; // reported once the decoder is drained
            const bool hurry = !input_.stored() && queue_.count() >= kBehind;
            decoder_->send(popped.some ? packet_.get() : nullptr, popped.arrived_s, hurry);
        }
    }

    void interrupt() {
        input_.interrupt();
        queue_.interrupt();
    }

  private:
    void stopReader() {
        if (!reader_.joinable()) return;
        input_.stop();
        queue_.stop();
        reader_.join();
    }

    void readPackets() {
        lowerThreadPriority();
        const Packet packet = makePacket();
        TokenBucket bucket(input_.stored() ? kStoredBurst_s : kLiveBurst_s);
        const double unit_s = av_q2d(input_.video().time_base);
        for (;;) {
            if (Status read = input_.read(*packet); !read) return queue_.close(read.error().reason);
            if (input_.stamped() && packet->dts != AV_NOPTS_VALUE) {
                const double wait_s = bucket.wait_s(static_cast<double>(packet->dts) * unit_s, liveNow_s());
                if (wait_s > 0 && !queue_.sleep(wait_s)) break;
            }
            if (!queue_.push(*packet, liveNow_s())) break;
        }
        queue_.close("was stopped");
    }

    StreamInput input_;
    PacketQueue queue_;
    std::optional<PictureDecoder> decoder_;
    Packet packet_ = makePacket();
    double lastShown_s_ = 0;
    bool ended_ = false;
    std::thread reader_;
};

} // namespace

LiveFeed feedFrom(const LiveAddress& address, const FeedTimeouts& timeouts) {
    if (const auto* camera = std::get_if<CameraAddress>(&address)) return cameraFeed(*camera);
    const auto* pipe = std::get_if<PipeAddress>(&address);
    const auto stream = std::make_shared<Stream>(address, timeouts);
    return {.name = pipe ? pipe->file.string() : withoutPassword(std::get<StreamAddress>(address).url),
            .kind = pipe ? "pipe" : "stream",
            .open = [stream] { return stream->open(); },
            .read = [stream](ImageRgb8& bgr) { return stream->read(bgr); },
            .interrupt = [stream] { stream->interrupt(); }};
}

} // namespace shoal::media
