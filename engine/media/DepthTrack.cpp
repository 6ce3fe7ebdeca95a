#include "engine/media/DepthTrack.h"

#include "engine/core/Hash.h"
#include "engine/core/Number.h"
#include "engine/media/Decoder.h"

#include <fmt/core.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace shoal::media {

static std::string tagOf(const AVFormatContext& input, const char* name) {
    const AVDictionaryEntry* tag = av_dict_get(input.metadata, name, nullptr, 0);
    return tag ? tag->value : "";
}

// Each of FFV1's slices ends with the CRC of the bytes before it, so the CRC of a whole slice is 0, and so is
// that of all slices (RFC 9043, 4.9.3). FFmpeg's decoder shows damaged slices as in the frame before.
static bool isWhole(const AVPacket& packet) {
    const AVCRC* table = av_crc_get_table(AV_CRC_32_IEEE);
    return packet.size > 0 && av_crc(table, 0, packet.data, static_cast<size_t>(packet.size)) == 0;
}

bool isDepthTrack(const DepthTrackInfo& info) {
    constexpr int kMinWidth = 16, kMaxWidth = 4096;
    constexpr double kMaxDuration_s = 1e6;
    const bool fits = info.width >= kMinWidth && info.width <= kMaxWidth && info.height == info.width / 2;
    return fits && std::has_single_bit(static_cast<unsigned>(info.width)) && info.frameCount > 0 &&
           info.duration_s > 0 && info.duration_s <= kMaxDuration_s &&
           info.frameCount <=
               std::max(info.duration_s * kMaxFps, 1.0); // so that stamps, whole milliseconds, differ
}

Path depthTrackOf(const Path& film) {
    Path stem = film;
    stem.replace_extension();
    if (stem.extension() == ".small") stem.replace_extension();
    return Path(stem.string() + ".depth.mkv");
}

Result<std::string> filmIdentity(const Path& film) {
    const auto begin = readFileBegin(film, 1 << 20);
    if (!begin) return begin.error();
    Hash hash;
    hash.bytes(begin->data(), begin->size());
    return fmt::format("{:016x}", hash.value());
}

struct DepthTrack::Impl {
    DepthTrackInfo info;
    FileDecoder in{.stream = 0};
    int next = 0; // number of the packet that is read next without a seek

    int numberOf(const AVPacket& from) const {
        if (from.pts == AV_NOPTS_VALUE) return -1;
        const double time_s = static_cast<double>(from.pts) * av_q2d(in.opened().time_base);
        const double number = std::round(time_s * info.frameCount / info.duration_s);
        return number >= 0 && number < info.frameCount ? static_cast<int>(number) : -1;
    }

    bool readPacket(int number) {
        constexpr int kReadOn = 32; // packets; a seek costs more
        if (number < next || number > next + kReadOn) {
            const double time_s = number * info.duration_s / info.frameCount;
            const auto stamp = static_cast<int64_t>(time_s / av_q2d(in.opened().time_base));
            if (!in.seek(stamp)) return false;
        }
        next = -1 - kReadOn; // unknown until the packet is found
        for (;;) {
            av_packet_unref(in.packet.get());
            if (av_read_frame(in.input.get(), in.packet.get()) < 0) return false;
            const int found = numberOf(*in.packet);
            if (found > number) return false;
            if (found < number) continue;
            next = number + 1;
            return true;
        }
    }
};

Result<DepthTrack> DepthTrack::open(const Path& file, const Path& film) {
    setUpDecoders();
    const auto failed = [&](const char* reason) { return Error{file.string(), reason}; };
    if (const auto begin = readFileBegin(file, 16); !begin) return begin.error();
    auto impl = makeHidden<Impl>();
    impl->in.input = openInput(file, "matroska");
    if (!impl->in.input || tagOf(*impl->in.input, depth_tags::kVersion).empty())
        return failed("is no depth track");
    const AVFormatContext& input = *impl->in.input;
    if (tagOf(input, depth_tags::kVersion) != depth_tags::kVersionValue ||
        tagOf(input, depth_tags::kLayout) != depth_tags::kLayoutValue)
        return failed("is a depth track of another version");
    if (!film.empty()) {
        const auto identity = filmIdentity(film);
        if (!identity) return identity.error();
        if (tagOf(input, depth_tags::kFilms).find(*identity) == std::string::npos)
            return failed("is the depth of another film");
    }
    DepthTrackInfo& info = impl->info;
    info.frameCount = parseNumber<int>(tagOf(input, depth_tags::kFrames)).value_or(0);
    info.duration_s = parseNumber<double>(tagOf(input, depth_tags::kDuration)).value_or(0);
    if (input.nb_streams != 1) return failed("is damaged: it holds more than one stream");
    const AVCodecParameters& coded = *input.streams[0]->codecpar;
    info.width = coded.width, info.height = coded.height;
    if (coded.codec_id != AV_CODEC_ID_FFV1 || !isDepthTrack(info))
        return failed("is damaged: its header makes no sense");
    if (!impl->in.decoder.open(impl->in.opened(), FrameThreading::None, 1))
        return failed("cannot be decoded");
    if (!impl->readPacket(info.frameCount - 1)) return failed("is cut short");
    return DepthTrack(std::move(impl));
}

const DepthTrackInfo& DepthTrack::info() const { return impl_->info; }

int DepthTrack::frameAt(double time_s) const {
    const DepthTrackInfo& info = impl_->info;
    const double turns = time_s / info.duration_s;
    const double share = turns - std::floor(turns);
    return static_cast<int>(std::floor(share * info.frameCount + 0.5)) % info.frameCount;
}

bool DepthTrack::read(int number, DepthFrame& out) {
    Impl& track = *impl_;
    if (number < 0 || number >= track.info.frameCount || !track.readPacket(number)) return false;
    if (!isWhole(*track.in.packet)) return false;
    Decoder& decoder = track.in.decoder;
    decoder.flush();
    decoder.send(track.in.packet.get());
    const AVFrame& frame = decoder.frame();
    if (!decoder.receive() || frame.format != kDepthPixels || frame.width != track.info.width ||
        frame.height != track.info.height)
        return false;
    out.width = frame.width, out.height = frame.height;
    const auto plane = [&](int index, int width, int height, std::vector<uint16_t>& codes) {
        codes.resize(static_cast<size_t>(width) * height);
        cv::min(cv::Mat(height, width, CV_16U, frame.data[index], static_cast<size_t>(frame.linesize[index])),
                double{kMaxDepthCode}, cv::Mat(height, width, CV_16U, codes.data()));
    };
    plane(0, frame.width, frame.height, out.inverse);
    plane(1, frame.width / 2, frame.height / 2, out.confidence);
    return true;
}

} // namespace shoal::media
