#include "engine/media/SphericalMetadata.h"

#include "engine/media/BoundedStream.h"
#include "engine/media/RdfText.h"
#include "engine/media/WebmMetadata.h"

#include <algorithm>
#include <fstream>
#include <vector>

namespace shoal::media {

namespace {

constexpr int kMaxBoxes = 8192;
constexpr int kMaxDepth = 12; // moov trak mdia minf stbl stsd entry sv3d proj are nine
constexpr uint64_t kMaxRdfBytes = 64 << 10;
constexpr uint32_t kMaxEdits = 64;

constexpr uint32_t name4(const char (&text)[5]) {
    return uint32_t(uint8_t(text[0])) << 24 | uint32_t(uint8_t(text[1])) << 16 |
           uint32_t(uint8_t(text[2])) << 8 | uint32_t(uint8_t(text[3]));
}

// ffcc8263-f855-4a93-8814-587a02521fdd
constexpr std::array<uint8_t, 16> kSphericalUuid = {0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93,
                                                    0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd};

struct Box {
    uint32_t name = 0;
    uint64_t begin = 0; // of the payload
    uint64_t end = 0;
};

// One track while it is being read; the first video track becomes the result.
struct Track {
    bool isVideo = false;
    SphericalMetadata v1, v2;
    int width = 0, height = 0;
    double editedUnits = 0; // of the movie's time scale
    double media_s = 0;
};

struct Mp4Scan {
    const BoundedStream& file;
    SphericalMetadata found{};
    bool done = false;
    int boxes = 0;
    uint32_t movieScale = 0;
    Track track{};

    // The box at `at` of a parent that ends at `end`.
    std::optional<Box> boxAt(uint64_t at, uint64_t end) const {
        if (end - at < 8) return std::nullopt;
        const auto head = file.bytes<8>(at);
        if (!head) return std::nullopt;
        uint64_t size = big32(*head, 0);
        uint64_t header = 8;
        if (size == 1) {
            const auto large = file.bytes<8>(at + 8);
            if (!large) return std::nullopt;
            size = big64(*large, 0);
            header = 16;
        } else if (size == 0) {
            size = end - at; // to the end of the parent
        }
        if (size < header) return std::nullopt;
        return Box{big32(*head, 4), std::min(at + header, end), at + std::min(size, end - at)};
    }

    template <class Visit> void children(uint64_t at, uint64_t end, int depth, Visit&& visit) {
        if (depth > kMaxDepth) return;
        while (at < end && !done) {
            if (++boxes > kMaxBoxes) {
                done = true;
                return;
            }
            const auto box = boxAt(at, end);
            if (!box) return;
            visit(*box);
            at = box->end;
        }
    }

    void movie(const Box& box, int depth) {
        switch (box.name) {
        case name4("moov"):
            children(box.begin, box.end, depth + 1, [&](const Box& b) { movie(b, depth + 1); });
            done = true; // there is one
            break;
        case name4("mvhd"):
            readMovieScale(box);
            break;
        case name4("trak"):
            track = {};
            children(box.begin, box.end, depth + 1, [&](const Box& b) { inTrack(b, depth + 1); });
            if (track.isVideo) finish();
            break;
        default:
            break;
        }
    }

    void inTrack(const Box& box, int depth) {
        switch (box.name) {
        case name4("mdia"):
        case name4("minf"):
        case name4("stbl"):
        case name4("edts"):
            children(box.begin, box.end, depth + 1, [&](const Box& b) { inTrack(b, depth + 1); });
            break;
        case name4("hdlr"):
            if (const auto b = payload<12>(box)) track.isVideo = track.isVideo || hasText(*b, 8, "vide");
            break;
        case name4("mdhd"):
            readMediaLength(box);
            break;
        case name4("elst"):
            readEdits(box);
            break;
        case name4("uuid"):
            readV1(box);
            break;
        case name4("stsd"): // version, flags, number of entries; then the entries
            if (box.end - box.begin >= 8)
                children(box.begin + 8, box.end, depth + 1, [&](const Box& b) { sampleEntry(b, depth + 1); });
            break;
        default:
            break;
        }
    }

    // VisualSampleEntry: 78 bytes, then boxes.
    void sampleEntry(const Box& box, int depth) {
        const auto b = payload<78>(box);
        if (!b) return;
        if (track.width == 0) {
            track.width = static_cast<int>(big16(*b, 24));
            track.height = static_cast<int>(big16(*b, 26));
        }
        children(box.begin + 78, box.end, depth + 1, [&](const Box& child) { inEntry(child, depth + 1); });
    }

    void inEntry(const Box& box, int depth) {
        SphericalMetadata& v2 = track.v2;
        switch (box.name) {
        case name4("sv3d"):
        case name4("proj"):
            children(box.begin, box.end, depth + 1, [&](const Box& b) { inEntry(b, depth + 1); });
            break;
        case name4("st3d"):
            if (const auto b = payload<5>(box)) {
                constexpr Layout kModes[] = {Layout::Mono, Layout::TopBottom, Layout::LeftRight};
                if ((*b)[4] < 3) v2.layout = kModes[(*b)[4]], v2.present = true;
            }
            break;
        case name4("prhd"): // 16.16 fixed point
            if (const auto b = payload<16>(box)) {
                const auto angle = [&](size_t at) {
                    return static_cast<float>(static_cast<int32_t>(big32(*b, at))) / 65536.0f;
                };
                v2.yaw_deg = std::clamp(angle(4), -180.0f, 180.0f);
                v2.pitch_deg = std::clamp(angle(8), -90.0f, 90.0f);
                v2.roll_deg = std::clamp(angle(12), -180.0f, 180.0f);
            }
            break;
        case name4("equi"):
            setProjection(v2, Projection::Equirect);
            if (const auto b = payload<20>(box)) { // 0.32 fixed point
                const auto part = [&](size_t at) { return static_cast<float>(big32(*b, at) / 4294967296.0); };
                setMissing(v2, part(4), part(8), part(12), part(16));
            }
            break;
        case name4("cbmp"):
            setProjection(v2, Projection::Cubemap);
            break;
        case name4("mshp"):
            setProjection(v2, Projection::Mesh);
            break;
        default:
            break;
        }
    }

    static void setProjection(SphericalMetadata& m, Projection projection) {
        m.present = true;
        if (m.projection == Projection::Unknown) m.projection = projection;
    }

    // Ignored where nothing would be left of the picture.
    static void setMissing(SphericalMetadata& m, float top, float bottom, float left, float right) {
        if (!(top >= 0 && bottom >= 0 && left >= 0 && right >= 0 && top + bottom < 1 && left + right < 1))
            return;
        m.missingTop = top, m.missingBottom = bottom, m.missingLeft = left, m.missingRight = right;
    }

    void readV1(const Box& box) {
        const auto uuid = payload<16>(box);
        if (!uuid || *uuid != kSphericalUuid) return;
        std::vector<uint8_t> bytes(std::min(box.end - box.begin - 16, kMaxRdfBytes));
        if (!file.read(box.begin + 16, bytes)) return;
        const std::string_view text = asText(bytes);
        const auto spherical = rdfValue(text, "GSpherical:Spherical");
        if (!spherical || (*spherical != "true" && *spherical != "True" && *spherical != "1")) return;
        SphericalMetadata& v1 = track.v1;
        v1.present = true;
        const auto projection = rdfValue(text, "GSpherical:ProjectionType");
        if (!projection || *projection == "equirectangular") v1.projection = Projection::Equirect;
        if (projection == "cubemap") v1.projection = Projection::Cubemap;
        const auto stereo = rdfValue(text, "GSpherical:StereoMode");
        if (stereo == "mono") v1.layout = Layout::Mono;
        if (stereo == "top-bottom") v1.layout = Layout::TopBottom;
        if (stereo == "left-right") v1.layout = Layout::LeftRight;
        readV1Cropping(text, v1);
    }

    static void readV1Cropping(std::string_view text, SphericalMetadata& v1) {
        const auto number = [&](const char* name) { return rdfNumber(text, name).value_or(-1); };
        const double fullWidth = number("GSpherical:FullPanoWidthPixels");
        const double fullHeight = number("GSpherical:FullPanoHeightPixels");
        const double width = number("GSpherical:CroppedAreaImageWidthPixels");
        const double height = number("GSpherical:CroppedAreaImageHeightPixels");
        const double left = number("GSpherical:CroppedAreaLeftPixels");
        const double top = number("GSpherical:CroppedAreaTopPixels");
        if (fullWidth < 1 || fullHeight < 1 || width < 1 || height < 1 || left < 0 || top < 0) return;
        setMissing(v1, static_cast<float>(top / fullHeight),
                   static_cast<float>(1 - (top + height) / fullHeight), static_cast<float>(left / fullWidth),
                   static_cast<float>(1 - (left + width) / fullWidth));
    }

    void readMovieScale(const Box& box) {
        const auto b = payload<24>(box);
        if (b) movieScale = big32(*b, (*b)[0] == 1 ? 20 : 12);
    }

    void readMediaLength(const Box& box) {
        const auto b =
            payload<24>(box); // version 0: times 4 + 4, scale, duration; version 1: 8 + 8, scale, 8
        if (!b) return;
        const bool wide = (*b)[0] == 1;
        const uint32_t scale = big32(*b, wide ? 20 : 12);
        const auto wideLength = wide ? file.bytes<8>(box.begin + 24) : std::nullopt;
        const double length = wide ? (wideLength ? static_cast<double>(big64(*wideLength, 0)) : 0.0)
                                   : static_cast<double>(big32(*b, 16));
        if (scale > 0) track.media_s = length / scale;
    }

    void readEdits(const Box& box) {
        const auto head = payload<8>(box);
        if (!head) return;
        const bool wide = (*head)[0] == 1;
        const uint64_t entrySize = wide ? 20 : 12;
        const uint32_t count = std::min(big32(*head, 4), kMaxEdits);
        for (uint32_t i = 0; i < count; ++i) {
            const uint64_t at = box.begin + 8 + i * entrySize;
            if (at + entrySize > box.end) return;
            std::array<uint8_t, 16> b{}; // length, then media time; -1 there is an empty edit
            if (!file.read(at, std::span(b).first(wide ? 16 : 8))) return;
            const bool empty = wide ? big64(b, 8) == ~uint64_t{0} : big32(b, 4) == ~uint32_t{0};
            if (!empty)
                track.editedUnits +=
                    wide ? static_cast<double>(big64(b, 0)) : static_cast<double>(big32(b, 0));
        }
    }

    void finish() {
        found = track.v2.projection != Projection::Unknown ? track.v2 : track.v1;
        if (found.present) found.version = track.v2.projection != Projection::Unknown ? 2 : 1;
        // st3d alone, or with V1 that is silent about stereo, still says how the eyes share the frame.
        if (track.v2.layout != Layout::Auto) {
            found.layout = track.v2.layout;
            if (!found.present) found.present = true, found.version = 2;
        }
        found.frameWidth = track.width;
        found.frameHeight = track.height;
        found.shown_s =
            track.editedUnits > 0 && movieScale > 0 ? track.editedUnits / movieScale : track.media_s;
        done = true;
    }

    template <size_t kCount> std::optional<std::array<uint8_t, kCount>> payload(const Box& box) const {
        if (box.end - box.begin < kCount) return std::nullopt;
        return file.bytes<kCount>(box.begin);
    }
};

} // namespace

const char* nameOf(Projection projection) {
    constexpr const char* kNames[] = {"unknown", "lat-long", "cube map", "mesh"};
    return kNames[static_cast<int>(projection)];
}

SphericalMetadata sphericalMetadataOf(std::istream& stream, uint64_t size) {
    const BoundedStream file{stream, size};
    const auto head = file.bytes<4>(0);
    if (head && big32(*head, 0) == 0x1A45DFA3) return webmMetadataOf(file);
    Mp4Scan scan{.file = file};
    scan.children(0, size, 0, [&](const Box& box) { scan.movie(box, 0); });
    return scan.found;
}

Result<SphericalMetadata> readSphericalMetadata(const Path& file) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code))
        return Error{file.string(), "there is no such file, or it is not a regular one"};
    std::ifstream stream(file, std::ios::binary);
    const uint64_t size = std::filesystem::file_size(file, code);
    if (!stream || code) return Error{file.string(), "cannot be opened; check its permissions"};
    return sphericalMetadataOf(stream, size);
}

} // namespace shoal::media
