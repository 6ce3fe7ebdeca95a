#include "engine/media/Check.h"

#include "engine/media/DescribeVideo.h"
#include "engine/media/PictureHeader.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoSource.h"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <fstream>

namespace shoal::media {

namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
    std::array<char, 256> text{};
    va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(text.data(), text.size(), pattern, arguments);
    va_end(arguments);
    return text.data();
}

std::string shapeNote(int width, int height) {
    const Layout layout = layoutFromShape(width, height);
    if (layout != Layout::Auto) return format("lat-long %s by its shape", nameOf(layout));
    return "not a 360-degree picture by its shape; `shoal panorama` grows it to one";
}

// The head alone: the reader proper reads the rest.
Result<PictureHeader> headerOf(const Path& file) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code))
        return Error{file.string(), "there is no such file, or it is not a regular one"};
    std::vector<uint8_t> head(1 << 20);
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
    auto header = readPictureHeader(std::span(head).first(static_cast<size_t>(stream.gcount())));
    if (!header) return Error{file.string(), header.error().reason};
    return header;
}

} // namespace

Result<std::string> checkVideo(const Path& file) {
    auto source = VideoSource::open(file);
    if (!source) return source.error();
    VideoInfo info;
    if (!resolveLayout(*source, Layout::Auto, info))
        return Error{file.string(), "its first frame cannot be decoded"};
    const SphericalMetadata& m = info.metadata;
    if (m.projection == Projection::Cubemap || m.projection == Projection::Mesh)
        return Error{file.string(), format("is a %s; only lat-long video can be shown, so convert it",
                                           nameOf(m.projection))};

    ImageRgb8 frame(info.width, info.height);
    const auto second = static_cast<int64_t>(info.fps);
    while (source->position() < second && source->grab()) {
    }
    if (source->position() == 0 || !source->retrieve(frame))
        return Error{file.string(), "its first frame cannot be decoded"};
    if (!source->seek(std::max(source->position(), info.frameCount - 1)))
        return Error{file.string(), "cannot be sought in"};
    // A file without a stated length is read through; the limit is an hour at the highest rate.
    constexpr int64_t kMaxFrames = 3600 * 240;
    while (source->position() < kMaxFrames && source->grab()) {
    }
    const int64_t frames = source->position();
    const int64_t tolerated = std::max<int64_t>(4, info.frameCount / 50); // as VideoPlayer does
    if (frames < info.frameCount - tolerated)
        return Error{file.string(), format("is damaged: only %.1f of %.1f s can be decoded",
                                           static_cast<double>(frames) / info.fps, info.duration_s)};
    const std::string codec = info.codec.empty() ? "" : info.codec + " ";
    std::string sentence =
        format("%dx%d %svideo, %.4g frames/s, %.1f s, %s colour, lat-long %s (%s)", info.width, info.height,
               codec.c_str(), info.fps, static_cast<double>(frames) / info.fps, nameOf(info.matrix),
               nameOf(info.layout), info.layoutSource);
    if (m.missingLeft + m.missingRight + m.missingTop + m.missingBottom > 0)
        sentence += "; covers only a part of the surround";
    if (!m.present) sentence += "; does not say that it is a 360-degree video";
    return sentence;
}

Result<std::string> checkPicture(const Path& file) {
    const auto header = headerOf(file);
    if (!header) return header.error();
    if (!isHdr(header->kind)) {
        const auto picture = readPicture(file);
        if (!picture) return picture.error();
        return format("%dx%d %s picture, ", picture->width, picture->height, nameOf(header->kind)) +
               shapeNote(picture->width, picture->height);
    }
    const auto picture = readHdr(file);
    if (!picture) return picture.error();
    float largest = 0;
    for (const float value : picture->radianceLin.pixels) largest = std::max(largest, value);
    std::string sentence =
        format("%dx%d %s picture, largest component %.4g, ", picture->radianceLin.width,
               picture->radianceLin.height, nameOf(header->kind), static_cast<double>(largest)) +
        shapeNote(picture->radianceLin.width, picture->radianceLin.height);
    if (picture->repaired > 0)
        sentence += format("; %lld components were NaN, infinite or negative and count as replaced",
                           static_cast<long long>(picture->repaired));
    return sentence;
}

} // namespace shoal::media
