#include "engine/media/Check.h"

#include "engine/media/DepthTrack.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/PictureHeader.h"
#include "engine/media/Pictures.h"
#include "engine/media/SoundTrack.h"
#include "engine/media/VideoSource.h"

#include <fmt/core.h>

#include <algorithm>

namespace shoal::media {

// Returns FFmpeg's format of a file that begins with these bytes; null: no format is certain. ID3 tags, which
// may be longer than these bytes, stand only before sound.
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

// Returns what environment::environmentFrom() makes of the photo.
static std::string shapeNote(const Photo& photo) {
    if (photo.metadata.isPart()) {
        const PanoramaPlacement& p = *photo.metadata.placement;
        return fmt::format("a part of a panorama ({}x{} at {}, {} of {}x{}), which is completed", p.width,
                           p.height, p.left, p.top, p.fullWidth, p.fullHeight);
    }
    const Layout layout = layoutOf(photo.picture, photo.metadata);
    return layout == Layout::Auto ? "an ordinary picture, which is grown to a 360-degree one"
                                  : fmt::format("lat-long {}", enumName(layout));
}

// Return checkVideo()'s clauses about a film's depth, empty if no track lies beside it, and about its sound.
static std::string depthNote(const Path& film) {
    const Path file = depthTrackOf(film);
    std::error_code missing;
    if (file == film || !std::filesystem::exists(file, missing)) return "";
    const auto track = DepthTrack::open(file, film);
    if (!track) return "; without depth, because " + file.filename().string() + " " + track.error().reason;
    return fmt::format("; with depth, {}x{}", track->info().width, track->info().height);
}

static std::string soundNote(const Path& film) {
    const auto sound = SoundTrack::open(film, 0);
    if (!sound) return "; " + sound.error().reason;
    return sound->channels() == 2 ? "; sound in stereo" : "; sound of all directions (ambisonics)";
}

constexpr const char* kTransferNotes[] = {"", " in PQ, lit as measured", " in HLG, lit as measured"};

Result<std::string> checkVideo(const Path& file) {
    auto source = VideoSource::open(file, Layout::Auto);
    if (!source) return source.error();
    const VideoInfo& info = source->info();
    ImageRgb8 frame(info.width, info.height);
    if (!source->grab() || !source->retrieve(frame))
        return Error{file.string(), "its first frame cannot be decoded"};
    const auto second = static_cast<int64_t>(info.fps);
    while (source->position() < second && source->grab()) {
    }
    if (!source->seek(std::max(source->position(), info.frameCount - 1)))
        return Error{file.string(), "cannot be sought in"};
    // A file without a stated length is read through; the limit is an hour at the highest rate.
    constexpr int64_t kMaxFrames = 3600 * 240;
    while (source->position() < kMaxFrames && source->grab()) {
    }
    const int64_t frames = source->position();
    if (frames < leastFrames(info.frameCount))
        return Error{file.string(), fmt::format("is damaged: only {:.1f} of {:.1f} s can be decoded",
                                                static_cast<double>(frames) / info.fps, info.duration_s)};
    std::string message = fmt::format(
        "{}x{} {} video, {:.4g} frames/s, {:.1f} s, {} colour{}, lat-long {} ({})", info.width, info.height,
        info.codec, info.storedFps, static_cast<double>(frames) / info.fps, nameOf(info.matrix),
        kTransferNotes[static_cast<size_t>(info.transfer)], enumName(info.layout), info.layoutSource);
    message += info.metadata.note();
    if (!info.metadata.isStated()) message += "; does not say that it is a 360-degree video";
    return message + soundNote(file) + depthNote(file);
}

Result<std::string> checkDepthTrack(const Path& file) {
    auto track = DepthTrack::open(file);
    if (!track) return track.error();
    const DepthTrackInfo& info = track->info();
    DepthFrame frame;
    int whole = 0, nearest = 0;
    double confidence = 0, count = 0;
    for (int i = 0; i < info.frameCount; ++i) {
        if (!track->read(i, frame)) continue;
        ++whole;
        nearest = std::max<int>(nearest, *std::ranges::max_element(frame.inverse));
        for (const uint16_t each : frame.confidence) confidence += each;
        count += static_cast<double>(frame.confidence.size());
    }
    if (whole < info.frameCount)
        return Error{file.string(),
                     fmt::format("is damaged: {} of {} frames can be decoded", whole, info.frameCount)};
    const double nearest_m =
        nearest ? double{kMaxDepthCode} / (static_cast<double>(kMaxInverse_perM) * nearest) : 0;
    return fmt::format("{}x{} depth track, {:.4g} frames/s, {:.1f} s, {}, mean confidence {:.0f} %",
                       info.width, info.height, info.frameCount / info.duration_s, info.duration_s,
                       nearest ? fmt::format("nearest {:.2f} m", nearest_m) : "all far away",
                       100 * confidence / (count * kMaxDepthCode));
}

Result<std::string> checkPicture(const Path& file, const std::string& layer) {
    const auto begin = readFileBegin(file, 1 << 20);
    if (!begin) return begin.error();
    const auto kind = pictureKind(*begin);
    if (!kind) return Error{file.string(), kind.error().reason};
    if (!layer.empty() && *kind != PictureKind::Exr) return Error{file.string(), kNoLayers};
    if (!isHdr(*kind)) {
        const auto photo = readPhoto(file);
        if (!photo) return photo.error();
        return fmt::format("{}x{} {} picture, {}{}", photo->picture.width, photo->picture.height,
                           nameOf(*kind), shapeNote(*photo), photo->note());
    }
    const auto picture = readHdr(file, {}, layer);
    if (!picture) return picture.error();
    const ImageRgbF& image = picture->radianceLin;
    const char* shape =
        layoutOf(image) == Layout::Mono
            ? "lat-long mono by its shape"
            : "an ordinary picture by its shape, which `shoal panorama` grows to a 360-degree one";
    return fmt::format("{}x{} {} picture, largest component {:.4g}, {}{}", image.width, image.height,
                       nameOf(*kind), *std::ranges::max_element(image.pixels), shape, picture->note());
}

Result<std::string> checkMedia(const Path& file, const std::string& layer) {
    const auto kind = mediaKind(file, layer);
    if (!kind) return kind.error();
    return *kind == MediaKind::Video        ? checkVideo(file)
           : *kind == MediaKind::DepthTrack ? checkDepthTrack(file)
                                            : checkPicture(file, layer);
}

} // namespace shoal::media
