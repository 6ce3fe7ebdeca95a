#include "engine/media/PhotoMetadata.h"

#include "engine/core/Number.h"
#include "engine/math/Trigonometry.h"
#include "engine/media/PictureHeader.h"

#include <fmt/core.h>
#include <zlib.h>

#include <map>

namespace shoal::media {

namespace {

// Metadata without the headers of the photo's file.
struct Blocks {
    ByteSpan exif; // a TIFF structure
    std::string xmp;
    std::vector<uint8_t> profile;
};

std::vector<uint8_t> copyOf(ByteSpan bytes) { return {bytes.begin(), bytes.end()}; }

// Returns what zlib has packed; empty if it is damaged or too large.
std::vector<uint8_t> unpacked(ByteSpan packed) {
    std::vector<uint8_t> bytes(4 << 20);
    uLongf size = bytes.size();
    if (uncompress(bytes.data(), &size, packed.data(), packed.size()) != Z_OK) size = 0;
    bytes.resize(size);
    return bytes;
}

Blocks jpegBlocks(ByteSpan bytes) {
    constexpr std::string_view kExif{"Exif\0\0", 6}, kXmp{"http://ns.adobe.com/xap/1.0/\0", 29},
        kProfile{"ICC_PROFILE\0", 12};
    Blocks found;
    std::map<uint8_t, ByteSpan> profile; // its parts by their numbers, from 1
    size_t parts = 0;
    walkJpeg(bytes, [&](uint8_t marker, ByteSpan payload) {
        if (marker == 0xe1 && hasText(payload, 0, kExif)) found.exif = payload.subspan(kExif.size());
        if (marker == 0xe1 && hasText(payload, 0, kXmp)) found.xmp = asText(payload.subspan(kXmp.size()));
        if (marker == 0xe2 && hasText(payload, 0, kProfile) && payload.size() >= 14) {
            profile[payload[12]] = payload.subspan(14);
            parts = payload[13];
        }
        return false;
    });
    if (profile.size() == parts)
        for (const auto& [number, part] : profile)
            found.profile.insert(found.profile.end(), part.begin(), part.end());
    return found;
}

// Calls visit(name, data) for each chunk of a PNG (size, name, data, checksum) or a WebP (name, size, data).
template <class Visit> void walkChunks(ByteSpan b, bool png, Visit&& visit) {
    for (size_t at = png ? 8 : 12; at + 8 <= b.size();) {
        const size_t size = png ? big32(b, at) : little32(b, at + 4);
        if (size > b.size() - at - 8) return;
        visit(asText(b.subspan(png ? at + 4 : at, 4)), b.subspan(at + 8, size));
        at += 8 + size + (png ? 4 : size & 1);
    }
}

// Keyword 0 packed method language 0 keyword 0 text (PNG specification, section 11.3.3.4).
std::string internationalText(ByteSpan data) {
    const std::string_view text = asText(data);
    const size_t packed = text.find('\0') + 1; // the caller has found the keyword
    const size_t language = text.find('\0', packed + 2);
    const size_t keyword = language == text.npos ? text.npos : text.find('\0', language + 1);
    if (keyword == text.npos) return "";
    const ByteSpan value = data.subspan(keyword + 1);
    return std::string(asText(data[packed] ? unpacked(value) : copyOf(value)));
}

Blocks pngBlocks(ByteSpan bytes) {
    constexpr std::string_view kXmp{"XML:com.adobe.xmp\0", 18};
    Blocks found;
    bool hadXmp = false, hadProfile = false; // only the first is unpacked: a file may hold thousands
    walkChunks(bytes, true, [&](std::string_view name, ByteSpan data) {
        if (name == "eXIf") found.exif = data;
        if (name == "iTXt" && hasText(data, 0, kXmp) && !std::exchange(hadXmp, true))
            found.xmp = internationalText(data);
        if (name == "iCCP" && !std::exchange(hadProfile, true)) { // name 0 method profile
            const size_t end = asText(data).find('\0');
            if (end != std::string_view::npos && data.size() - end > 2)
                found.profile = unpacked(data.subspan(end + 2));
        }
    });
    return found;
}

Blocks webpBlocks(ByteSpan bytes) {
    Blocks found;
    walkChunks(bytes, false, [&](std::string_view name, ByteSpan data) {
        const bool named = hasText(data, 0, "Exif"); // some programs write a JPEG's header
        if (name == "EXIF") found.exif = data.subspan(named ? std::min<size_t>(data.size(), 6) : 0);
        if (name == "XMP ") found.xmp = asText(data);
        if (name == "ICCP") found.profile = copyOf(data);
    });
    return found;
}

Blocks blocksIn(ByteSpan bytes, PictureKind kind) {
    switch (kind) {
    case PictureKind::Jpeg:
        return jpegBlocks(bytes);
    case PictureKind::Png:
        return pngBlocks(bytes);
    case PictureKind::Webp:
        return webpBlocks(bytes);
    case PictureKind::Tiff:
        return {bytes, std::string(asText(tiffEntry(bytes, TiffTag::Xmp))),
                copyOf(tiffEntry(bytes, TiffTag::Profile))};
    default:
        return {};
    }
}

void readGPano(std::string_view xmp, PhotoMetadata& m) {
    const std::string space = "GPano:";
    if (xmpValue(xmp, space + "ProjectionType") != "equirectangular") return;
    const auto degrees = [&](const char* name) {
        return parseNumber(xmpValue(xmp, space + name), -360.0f, 360.0f).value_or(0);
    };
    m.heading_deg = degrees("PoseHeadingDegrees");
    m.pitch_deg = degrees("PosePitchDegrees");
    m.roll_deg = degrees("PoseRollDegrees");
    m.placement = placementIn(xmp, space);
    constexpr double kLeastShare = 1.0 / 64; // as of films
    if (m.placement && (m.placement->width < m.placement->fullWidth * kLeastShare ||
                        m.placement->height < m.placement->fullHeight * kLeastShare))
        m.placement.reset();
    m.placementIgnored = !m.placement && !xmpValue(xmp, space + "FullPanoWidthPixels").empty();
}

} // namespace

glm::quat PhotoMetadata::envFromPhoto() const {
    return math::rotationAbout({1, 0, 0}, glm::radians(pitch_deg)) *
           math::rotationAbout({0, 0, -1}, glm::radians(roll_deg));
}

std::string PhotoMetadata::note() const {
    std::string text;
    if (orientation != 1) text += fmt::format("; turned upright from its EXIF orientation {}", orientation);
    if (placementIgnored) text += "; its place in a panorama contradicts itself or is too small, and is ignored";
    if (pitch_deg != 0 || roll_deg != 0)
        text += fmt::format("; levelled, of pitch {:.4g} and roll {:.4g} degrees", pitch_deg, roll_deg);
    if (heading_deg != 0)
        text +=
            fmt::format("; its middle stays ahead, though it heads {:.4g} degrees from north", heading_deg);
    return text;
}

PhotoMetadata photoMetadata(ByteSpan bytes, PictureKind kind) {
    Blocks found = blocksIn(bytes, kind);
    PhotoMetadata m;
    const uint32_t orientation = tiffNumber(found.exif, TiffTag::Orientation);
    if (orientation >= 1 && orientation <= 8) m.orientation = static_cast<int>(orientation);
    readGPano(found.xmp, m);
    m.profile = std::move(found.profile);
    return m;
}

} // namespace shoal::media
