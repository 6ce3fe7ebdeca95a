#include "engine/media/live/StreamFeed.h"

#include "engine/core/Threads.h"
#include "engine/media/PictureDecoder.h"
#include "engine/media/live/Pace.h"
#include "engine/media/live/PacketQueue.h"
#include "engine/media/live/StreamInput.h"

extern "C" {
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

namespace shoal::media {

namespace {

// What may come at once before it is held to its own time stamps.
constexpr double kLiveAhead_s = 3, kStoredAhead_s = 0.05;
// While catching up, a picture is shown at least every so often.
constexpr double kLongestHidden_s = 0.25;
// Packets that wait while one is decoded: more than a network's unevenness.
constexpr size_t kBehind = 3;

class Stream {
  public:
    Stream(const LiveAddress& address, const FeedPatience& patience) : input_(address, patience) {}
    ~Stream() { endReader(); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    Status open() {
        endReader();
        if (Status opened = input_.open(); !opened) return opened;
        decoder_.emplace();
        const AVStream& picture = input_.picture();
        const auto threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
        if (Status opened = decoder_->open(*picture.codecpar, picture.time_base, HoldBack::None, threads);
            !opened)
            return opened;
        queue_.reset(input_.stored());
        lastGiven_s_ = liveNow_s();
        ended_ = false;
        reader_ = std::thread([this] { readAll(); });
        return Done{};
    }

    Result<LivePicture> read(ImageRgb8& bgr) {
        LivePicture picture;
        double began_s = liveNow_s();
        for (;;) {
            while (decoder_->receive()) {
                // Older than what is there already: decoded because others need it.
                if (queue_.count() > 0 && !input_.stored() && liveNow_s() - lastGiven_s_ < kLongestHidden_s) {
                    ++picture.passedOver;
                    continue;
                }
                if (Status converted = decoder_->convert(bgr); !converted) return converted.error();
                picture.arrived_s = decoder_->arrived_s();
                lastGiven_s_ = liveNow_s();
                picture.decode_ms = 1e3 * (lastGiven_s_ - began_s);
                return picture;
            }
            if (ended_) return Error{"", queue_.reason()};
            const PacketQueue::Popped popped = queue_.pop(packet_);
            began_s = liveNow_s();
            if (popped.dropped > 0) decoder_->forget();
            picture.passedOver += popped.dropped;
            ended_ = !popped.some; // what the decoder still holds back comes out before that is said
            const bool hurry = !input_.stored() && queue_.count() >= kBehind;
            decoder_->send(popped.some ? packet_.get() : nullptr, popped.arrived_s, hurry);
        }
    }

    void interrupt() {
        input_.interrupt();
        queue_.interrupt();
    }

  private:
    void endReader() {
        if (!reader_.joinable()) return;
        input_.leave();
        queue_.leave();
        reader_.join();
    }

    void readAll() {
        stepBack();
        const Packet packet = makePacket();
        Pace pace(input_.stored() ? kStoredAhead_s : kLiveAhead_s);
        const double unit_s = av_q2d(input_.picture().time_base);
        for (;;) {
            if (Status read = input_.read(*packet); !read) return queue_.close(read.error().reason);
            if (input_.stamped() && packet->dts != AV_NOPTS_VALUE) {
                const double wait_s = pace.wait_s(static_cast<double>(packet->dts) * unit_s, liveNow_s());
                if (wait_s > 0 && !queue_.rest(wait_s)) break;
            }
            if (!queue_.push(*packet, liveNow_s())) break;
        }
        queue_.close("was left");
    }

    StreamInput input_;
    PacketQueue queue_;
    std::optional<PictureDecoder> decoder_;
    Packet packet_ = makePacket();
    double lastGiven_s_ = 0;
    bool ended_ = false;
    std::thread reader_;
};

} // namespace

LiveFeed streamFeed(const LiveAddress& address, const FeedPatience& patience) {
    const auto* pipe = std::get_if<PipeAddress>(&address);
    const auto stream = std::make_shared<Stream>(address, patience);
    return {.name = pipe ? pipe->file.string() : withoutPassword(std::get<StreamAddress>(address).url),
            .kind = pipe ? "pipe" : "stream",
            .open = [stream] { return stream->open(); },
            .read = [stream](ImageRgb8& bgr) { return stream->read(bgr); },
            .interrupt = [stream] { stream->interrupt(); }};
}

} // namespace shoal::media
