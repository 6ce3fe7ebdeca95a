#include "engine/media/SphericalMetadata.h"

#include "engine/core/Number.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/PictureHeader.h"

extern "C" {
#include <libavutil/spherical.h>
#include <libavutil/stereo3d.h>
}

#include <array>
#include <fstream>

namespace shoal::media {

std::string_view xmpValue(std::string_view xmp, const std::string& name) {
    const size_t at = xmp.find(name);
    const size_t begin = at == xmp.npos ? at : xmp.find_first_not_of(" \t\r\n=>\"'", at + name.size());
    return begin == xmp.npos ? "" : xmp.substr(begin, xmp.find_first_of(" \t\r\n<\"'", begin) - begin);
}

std::optional<PanoramaPlacement> placementIn(std::string_view xmp, const std::string& space) {
    constexpr int kMaxPixels = 1 << 20;
    const auto pixels = [&](const char* name) {
        return parseNumber(xmpValue(xmp, space + name), 0, kMaxPixels).value_or(-1);
    };
    const PanoramaPlacement p{.fullWidth = pixels("FullPanoWidthPixels"),
                              .fullHeight = pixels("FullPanoHeightPixels"),
                              .left = pixels("CroppedAreaLeftPixels"),
                              .top = pixels("CroppedAreaTopPixels"),
                              .width = pixels("CroppedAreaImageWidthPixels"),
                              .height = pixels("CroppedAreaImageHeightPixels")};
    if (p.left < 0 || p.top < 0 || p.width < 1 || p.height < 1) return std::nullopt;
    if (p.left + p.width > p.fullWidth || p.top + p.height > p.fullHeight) return std::nullopt;
    return p;
}

// Returns the beginning of an MP4 file's movie box, or of a Matroska file; empty if there is none.
static std::string headerText(const Path& file, bool matroska) {
    std::ifstream stream(file, std::ios::binary);
    std::array<uint8_t, 16> head{}; // size, name, and the large size if size is 1
    for (uint64_t at = 0; !matroska && !hasText(head, 4, "moov");) {
        stream.seekg(static_cast<std::streamoff>(at));
        if (!stream.read(reinterpret_cast<char*>(head.data()), head.size())) return {};
        const uint64_t size = big32(head, 0) == 1 ? big64(head, 8) : big32(head, 0);
        if (size < 8 || size > INT64_MAX - at) return {};
        at += size;
    }
    std::string header(1 << 20, 0);
    stream.read(header.data(), static_cast<std::streamsize>(header.size()));
    return header;
}

// Reads what libavformat drops: meshes, version 2 without its header box, version 1 without the name of the
// stitching software.
static SphericalMetadata unreadMetadata(const Path& file, bool matroska) {
    constexpr std::string_view kMatroskaMesh = "\x76\x71\x81\x03"; // ProjectionType, of one byte: 3
    const std::string header = headerText(file, matroska);
    SphericalMetadata m;
    if (matroska) {
        if (header.find(kMatroskaMesh) != header.npos) m.projection = Projection::Mesh;
    } else if (const size_t v2 = header.find("sv3d"); v2 != header.npos) {
        const std::string_view boxes = std::string_view(header).substr(v2, 1024);
        m.projection = boxes.find("mshp") != boxes.npos   ? Projection::Mesh
                       : boxes.find("cbmp") != boxes.npos ? Projection::Cubemap
                       : boxes.find("equi") != boxes.npos ? Projection::Equirect
                                                          : Projection::Unknown;
    } else if (xmpValue(header, "GSpherical:Spherical") == "true") {
        m.projection = Projection::Equirect;
        m.layout = enumNamed<Layout>(xmpValue(header, "GSpherical:StereoMode")).value_or(Layout::Auto);
    }
    return m;
}

SphericalMetadata sphericalMetadata(const AVFormatContext& input, const AVStream& stream, const Path& file) {
    const bool matroska = std::string_view(input.iformat->name).starts_with("matroska");
    SphericalMetadata m;
    if (stream.codecpar->codec_type != AVMEDIA_TYPE_VIDEO) return m;
    if (const auto* s = sideData<AVSphericalMapping>(stream, AV_PKT_DATA_SPHERICAL)) {
        m.projection = s->projection == AV_SPHERICAL_CUBEMAP ? Projection::Cubemap : Projection::Equirect;
        m.partial = s->projection == AV_SPHERICAL_EQUIRECTANGULAR_TILE;
    } else {
        m = unreadMetadata(file, matroska);
        if (matroska && m.projection == Projection::Unknown)
            return m; // a flat video: its StereoMode does not describe a panorama
    }
    if (const auto* s = sideData<AVStereo3D>(stream, AV_PKT_DATA_STEREO3D))
        m.layout = s->type == AV_STEREO3D_2D           ? Layout::Mono
                   : s->type == AV_STEREO3D_SIDEBYSIDE ? Layout::LeftRight
                   : s->type == AV_STEREO3D_TOPBOTTOM  ? Layout::TopBottom
                                                       : Layout::Auto;
    m.present = m.projection != Projection::Unknown || m.layout != Layout::Auto;
    return m;
}

} // namespace shoal::media
