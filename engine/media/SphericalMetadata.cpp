#include "engine/media/SphericalMetadata.h"

#include "engine/media/PictureHeader.h"

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/spherical.h>
#include <libavutil/stereo3d.h>
}

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <vector>

namespace shoal::media {

namespace {

// --- RDF and XMP text. Single values do not need an XML parser, which would meet hostile entities.

// The text of <name>value</name> or name="value", whichever comes first, without surrounding white space.
// Empty if absent, not closed, or longer than 64 characters.
std::string_view rdfValue(std::string_view text, std::string_view name) {
    constexpr std::string_view kSpace = " \t\r\n";
    for (size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
        size_t begin = text.find_first_not_of(kSpace, at + name.size());
        if (begin == text.npos) return {};
        char close = 0;
        if (text[begin] == '>' && at > 0 && text[at - 1] == '<') {
            close = '<';
        } else if (text[begin] == '=') {
            begin = text.find_first_not_of(kSpace, begin + 1);
            if (begin == text.npos || (text[begin] != '"' && text[begin] != '\'')) continue;
            close = text[begin];
        } else {
            continue; // a closing tag, or a longer name
        }
        const std::string_view window = text.substr(begin + 1, 65);
        const std::string_view value = window.substr(0, window.find(close));
        const size_t first = value.find_first_not_of(kSpace);
        if (value.size() == window.size() || first == value.npos) return {};
        return value.substr(first, value.find_last_not_of(kSpace) - first + 1);
    }
    return {};
}

std::optional<double> rdfNumber(std::string_view text, std::string_view name) {
    const std::string_view value = rdfValue(text, name);
    double number = 0;
    const auto [end, code] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (code != std::errc{} || !std::isfinite(number)) return std::nullopt;
    return number;
}

// Google uses the same six names for photos (GPano) and for videos of version 1 (GSpherical).
std::optional<PanoramaPlacement> placementIn(std::string_view text, const std::string& prefix) {
    constexpr double kMaxPixels = 1 << 20;
    const auto pixels = [&](const char* name) {
        const double value = rdfNumber(text, prefix + name).value_or(-1);
        return value >= 0 && value <= kMaxPixels ? static_cast<int>(value) : -1;
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

// --- MP4

struct Box {
    uint64_t begin = 0, end = 0; // of its payload; empty if there is no such box
};

class Mp4Reader {
  public:
    Mp4Reader(std::istream& stream, uint64_t size) : stream_(stream), size_(size) {}

    // The first bytes of a payload; nothing if it has fewer.
    template <size_t kCount> std::optional<std::array<uint8_t, kCount>> first(const Box& box) {
        std::array<uint8_t, kCount> bytes;
        if (box.end - box.begin < kCount || !read(box.begin, bytes)) return std::nullopt;
        return bytes;
    }

    bool read(uint64_t offset, std::span<uint8_t> out) {
        if (offset > size_ || size_ - offset < out.size()) return false;
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(offset));
        stream_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        return static_cast<size_t>(stream_.gcount()) == out.size();
    }

    // The first box of that name within `parent` that `accept` takes.
    template <class Accept> Box find(const Box& parent, std::string_view name, Accept&& accept) {
        for (uint64_t at = parent.begin; parent.end - at >= 8 && boxesLeft_-- > 0;) {
            std::array<uint8_t, 16> head{}; // size, name, and the large size if size is 1
            if (!read(at, std::span(head).first(8))) break;
            uint64_t size = big32(head, 0), header = 8;
            if (size == 1) {
                if (!read(at, head)) break;
                size = big64(head, 8);
                header = 16;
            }
            if (size == 0) size = parent.end - at; // to the end of the parent
            if (size < header) break;
            const uint64_t end = at + std::min(size, parent.end - at);
            const Box box{std::min(at + header, end), end};
            if (hasText(head, 4, name) && accept(box)) return box;
            at = end;
        }
        return {};
    }
    Box find(const Box& parent, std::string_view name) {
        return find(parent, name, [](const Box&) { return true; });
    }

  private:
    std::istream& stream_;
    uint64_t size_;
    int boxesLeft_ = 8192;
};

// Ignored where nothing would be left of the picture.
void setMissing(SphericalMetadata& m, double top, double bottom, double left, double right) {
    if (!(top + bottom < 1 && left + right < 1)) return;
    m.missingTop = static_cast<float>(top), m.missingBottom = static_cast<float>(bottom);
    m.missingLeft = static_cast<float>(left), m.missingRight = static_cast<float>(right);
}

// entry: what follows the 78 bytes of a VisualSampleEntry. The mandatory svhd is not asked for.
SphericalMetadata v2Of(Mp4Reader& mp4, const Box& entry) {
    SphericalMetadata m{.version = 2};
    if (const auto b = mp4.first<5>(mp4.find(entry, "st3d"))) {
        constexpr Layout kModes[] = {Layout::Mono, Layout::TopBottom, Layout::LeftRight};
        if ((*b)[4] < 3) m.layout = kModes[(*b)[4]];
    }
    const Box projection = mp4.find(mp4.find(entry, "sv3d"), "proj");
    if (const Box equi = mp4.find(projection, "equi"); equi.end > 0) {
        m.projection = Projection::Equirect;
        if (const auto b = mp4.first<20>(equi)) { // 0.32 fixed point
            const auto part = [&](size_t at) { return big32(*b, at) / 4294967296.0; };
            setMissing(m, part(4), part(8), part(12), part(16));
        }
    } else if (mp4.find(projection, "cbmp").end > 0) {
        m.projection = Projection::Cubemap;
    } else if (mp4.find(projection, "mshp").end > 0) {
        m.projection = Projection::Mesh;
    }
    return m;
}

SphericalMetadata v1Of(Mp4Reader& mp4, const Box& track) {
    // ffcc8263-f855-4a93-8814-587a02521fdd
    constexpr std::array<uint8_t, 16> kUuid = {0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93,
                                               0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd};
    constexpr uint64_t kMaxTextBytes = 64 << 10;
    const Box box = mp4.find(track, "uuid", [&](const Box& b) { return mp4.first<16>(b) == kUuid; });
    if (box.end == 0) return {};
    std::vector<uint8_t> bytes(std::min(box.end - box.begin - kUuid.size(), kMaxTextBytes));
    if (!mp4.read(box.begin + kUuid.size(), bytes)) return {};
    const std::string_view text = asText(bytes);
    const std::string_view spherical = rdfValue(text, "GSpherical:Spherical");
    if (spherical != "true" && spherical != "True" && spherical != "1") return {};
    SphericalMetadata m{.present = true, .version = 1};
    const std::string_view projection = rdfValue(text, "GSpherical:ProjectionType");
    if (projection.empty() || projection == "equirectangular") m.projection = Projection::Equirect;
    if (projection == "cubemap") m.projection = Projection::Cubemap;
    const std::string_view stereo = rdfValue(text, "GSpherical:StereoMode");
    if (stereo == "mono") m.layout = Layout::Mono;
    if (stereo == "top-bottom") m.layout = Layout::TopBottom;
    if (stereo == "left-right") m.layout = Layout::LeftRight;
    if (const auto p = placementIn(text, "GSpherical:")) {
        const double width = p->fullWidth, height = p->fullHeight;
        setMissing(m, p->top / height, 1 - (p->top + p->height) / height, p->left / width,
                   1 - (p->left + p->width) / width);
    }
    return m;
}

} // namespace

const char* nameOf(Projection projection) {
    constexpr const char* kNames[] = {"unknown", "lat-long", "cube map", "mesh"};
    return kNames[static_cast<int>(projection)];
}

SphericalMetadata mp4Metadata(std::istream& stream, uint64_t size) {
    Mp4Reader mp4(stream, size);
    const Box track = mp4.find(mp4.find({0, size}, "moov"), "trak", [&](const Box& candidate) {
        const auto handler = mp4.first<12>(mp4.find(mp4.find(candidate, "mdia"), "hdlr"));
        return handler && hasText(*handler, 8, "vide");
    });
    Box entries = mp4.find(mp4.find(mp4.find(mp4.find(track, "mdia"), "minf"), "stbl"), "stsd");
    entries.begin = std::min(entries.begin + 8, entries.end); // version, flags, number of entries
    // VisualSampleEntry, whatever its name: 78 bytes, then boxes.
    Box entry = mp4.find(entries, "");
    entry.begin = std::min(entry.begin + 78, entry.end);

    const SphericalMetadata v2 = v2Of(mp4, entry);
    SphericalMetadata found = v2.projection != Projection::Unknown ? v2 : v1Of(mp4, track);
    found.present = found.projection != Projection::Unknown || found.present;
    // st3d alone, or beside V1 that states no stereo layout, still says how the eyes share the frame.
    if (v2.layout != Layout::Auto) {
        found.layout = v2.layout;
        if (!found.present) found.present = true, found.version = 2;
    }
    return found;
}

SphericalMetadata matroskaMetadata(const AVStream& stream, ByteSpan fileBegin) {
    SphericalMetadata m;
    size_t size = 0;
    if (const auto* s = reinterpret_cast<const AVSphericalMapping*>(
            av_stream_get_side_data(&stream, AV_PKT_DATA_SPHERICAL, &size))) {
        m.projection = s->projection == AV_SPHERICAL_CUBEMAP ? Projection::Cubemap : Projection::Equirect;
        const auto part = [](uint32_t fixed) { return fixed / 4294967296.0; };
        if (s->projection == AV_SPHERICAL_EQUIRECTANGULAR_TILE)
            setMissing(m, part(s->bound_top), part(s->bound_bottom), part(s->bound_left),
                       part(s->bound_right));
    } else if (asText(fileBegin).find("\x76\x71\x81\x03") != std::string_view::npos) {
        // libavformat drops meshes: ProjectionType, of one byte, 3.
        m.projection = Projection::Mesh;
    } else {
        return m; // a flat video: its StereoMode does not describe a panorama
    }
    m.present = true;
    if (const auto* s = reinterpret_cast<const AVStereo3D*>(
            av_stream_get_side_data(&stream, AV_PKT_DATA_STEREO3D, &size)))
        m.layout = s->type == AV_STEREO3D_2D           ? Layout::Mono
                   : s->type == AV_STEREO3D_SIDEBYSIDE ? Layout::LeftRight
                   : s->type == AV_STEREO3D_TOPBOTTOM  ? Layout::TopBottom
                                                       : Layout::Auto;
    return m;
}

std::optional<PanoramaPlacement> panoramaPlacement(const Path& file) {
    const auto head = readFileBegin(file, 1 << 20); // the XMP segment is among the first
    if (!head || !hasText(*head, 0, "\xff\xd8\xff")) return std::nullopt;
    std::optional<PanoramaPlacement> found;
    walkJpeg(*head, [&](uint8_t marker, ByteSpan payload) {
        constexpr std::string_view kXmp{"http://ns.adobe.com/xap/1.0/\0", 29};
        if (marker != 0xe1 || !hasText(payload, 0, kXmp)) return false;
        const std::string_view xmp = asText(payload.subspan(kXmp.size()));
        if (rdfValue(xmp, "GPano:ProjectionType") == "equirectangular") found = placementIn(xmp, "GPano:");
        return found.has_value();
    });
    return found;
}

} // namespace shoal::media
