#include "engine/media/MediaKind.h"

#include "engine/media/DepthTrack.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/PictureHeader.h"

#include <fmt/core.h>

extern "C" {
#include <libavutil/avstring.h>
}

#include <algorithm>

namespace shoal::media {

// Returns FFmpeg's format of a file that begins so; null: none is certain. ID3: tags, before sound alone,
// that may be longer than these bytes.
static const AVInputFormat* probe(std::vector<uint8_t> begin) {
    const auto size = static_cast<int>(begin.size());
    begin.resize(begin.size() + AVPROBE_PADDING_SIZE);
    const AVProbeData data{.filename = "", .buf = begin.data(), .buf_size = size, .mime_type = nullptr};
    if (hasText(begin, 0, "ID3")) return av_find_input_format("mp3");
    int score = 0;
    const AVInputFormat* format = av_probe_input_format3(&data, 1, &score);
    return score > AVPROBE_SCORE_RETRY ? format : nullptr;
}

static bool holdsOnlySound(AVFormatContext& input) {
    if ((input.ctx_flags & AVFMTCTX_NOHEADER) != 0) return false; // further streams may come
    const std::span<AVStream*> streams(input.streams, input.nb_streams);
    return filmStreamOf(input) < 0 && std::ranges::any_of(streams, [](const AVStream* each) {
               return each->codecpar->codec_type == AVMEDIA_TYPE_AUDIO;
           });
}

Result<MediaKind> mediaKind(const Path& file, const std::string& layer) {
    constexpr uint64_t kBegin = 16 << 10; // some packets of any kind of sound
    constexpr const char* kSounds = "mp3,flac,wav,w64,aac,ac3,aiff,amr,caf,ape,wv";
    const auto failed = [&](std::string reason) { return Error{file.string(), std::move(reason)}; };
    auto begin = readFileBegin(file, kBegin);
    if (!begin) return begin.error();
    if (begin->empty()) return failed("is empty");
    const auto picture = pictureKind(*begin);
    if (!picture && unreadKind(*begin)) return failed(picture.error().reason);
    if (!layer.empty() && !(picture && *picture == PictureKind::Exr)) return failed(kNoLayers);
    if (picture) return isHdr(*picture) ? MediaKind::Hdr : MediaKind::Photo;
    setUpDecoders();
    const AVInputFormat* format = probe(std::move(*begin));
    const auto isOneOf = [&](const char* formats) {
        return format && av_match_list(format->name, formats, ',') != 0;
    };
    if (isOneOf(kSounds)) return failed("is only sound");
    if (format && !isOneOf(kVideoContainers))
        return failed(fmt::format("is of a kind that is not read: {}", format->long_name));
    const Input input = format ? openInput(file, kVideoContainers) : nullptr;
    if (!input)
        return failed(
            "is neither a picture (JPEG, PNG, BMP, WebP, TIFF, AVIF, PNM, HDR, EXR, PFM) nor a video "
            "of a known kind (MP4, MOV, WebM, MKV, AVI, MPEG, OGG, FLV), or is damaged at its "
            "beginning");
    if (av_dict_get(input->metadata, depth_tags::kVersion, nullptr, 0)) return MediaKind::DepthTrack;
    if (holdsOnlySound(*input)) return failed("is only sound");
    return MediaKind::Video;
}

} // namespace shoal::media
