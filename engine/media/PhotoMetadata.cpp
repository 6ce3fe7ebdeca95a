#include "engine/media/PhotoMetadata.h"

#include "engine/core/Number.h"
#include "engine/math/Trigonometry.h"
#include "engine/media/PictureHeader.h"

#include <fmt/core.h>
#include <lcms2.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>

namespace shoal::media {

namespace {

using Profile = std::unique_ptr<void, decltype([](cmsHPROFILE each) { cmsCloseProfile(each); })>;
using Curve = std::unique_ptr<cmsToneCurve, decltype([](cmsToneCurve* each) { cmsFreeToneCurve(each); })>;
using Transform = std::unique_ptr<void, decltype([](cmsHTRANSFORM each) { cmsDeleteTransform(each); })>;

bool isGrey(const ImageRgb8& picture) {
    const auto& p = picture.pixels;
    for (size_t i = 0; i < p.size(); i += 3)
        if (p[i] != p[i + 1] || p[i] != p[i + 2]) return false;
    return true;
}

// Returns whether the transform leaves all of 6 x 6 x 6 colours as they are, within a level of 8 bits.
bool isIdentity(cmsHTRANSFORM transform) {
    for (int i = 0; i < 216; ++i) {
        const std::array from = {static_cast<uint8_t>(i % 6 * 51), static_cast<uint8_t>(i / 6 % 6 * 51),
                                 static_cast<uint8_t>(i / 36 * 51)};
        std::array<uint8_t, 3> to{};
        cmsDoTransform(transform, from.data(), to.data(), 1);
        if (!std::ranges::equal(from, to, [](int a, int b) { return std::abs(a - b) <= 1; })) return false;
    }
    return true;
}

// Metadata without the headers of the photo's file.
struct Blocks {
    ByteSpan exif; // a TIFF structure
    std::string xmp;
    std::vector<uint8_t> profile;
    size_t turns = 0;  // AVIF: quarter turns counterclockwise
    size_t mirror = 0; // AVIF, behind these: 1 exchanges top and bottom, 2 left and right
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

// Returns an RGB profile by a PNG's gamma and CIE coordinates of white, red, green and blue, in units of
// 1/100000; without them, those of sRGB; empty if they span no colours. 45455 stands for sRGB's curve (PNG
// specification, section 11.3.2.5), and so do gammas beyond 0.1 to 10.
std::vector<uint8_t> statedProfile(ByteSpan gamma, ByteSpan coordinates) {
    const uint32_t stated = gamma.empty() ? 45455 : big32(gamma, 0);
    std::array<double, 8> xy{0.3127, 0.329, 0.64, 0.33, 0.3, 0.6, 0.15, 0.06};
    for (size_t i = 0; !coordinates.empty() && i < 8; ++i) xy[i] = big32(coordinates, 4 * i) / 1e5;
    if (xy[1] <= 0 || xy[3] <= 0 || xy[5] <= 0 || xy[7] <= 0) return {};       // lcms divides by them
    const double srgb[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045}; // IEC 61966-2-1
    const bool isSrgb = stated == 45455 || stated < 10000 || stated > 1000000;
    const Curve curve(isSrgb ? cmsBuildParametricToneCurve(nullptr, 4, srgb)
                             : cmsBuildGamma(nullptr, 1e5 / stated));
    cmsToneCurve* const curves[] = {curve.get(), curve.get(), curve.get()};
    const cmsCIExyY white = {xy[0], xy[1], 1};
    const cmsCIExyYTRIPLE primaries = {{xy[2], xy[3], 1}, {xy[4], xy[5], 1}, {xy[6], xy[7], 1}};
    const Profile profile(curve ? cmsCreateRGBProfile(&white, &primaries, curves) : nullptr);
    cmsUInt32Number size = 0;
    if (!profile || !cmsSaveProfileToMem(profile.get(), nullptr, &size)) return {};
    std::vector<uint8_t> bytes(size);
    if (!cmsSaveProfileToMem(profile.get(), bytes.data(), &size)) bytes.clear();
    return bytes;
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

// Reads the chunks of PNG (lower-case "e" and "i"), WebP (four capitals) and AVIF.
Blocks chunkBlocks(ByteSpan bytes, PictureKind kind) {
    constexpr std::string_view kXmp{"XML:com.adobe.xmp\0", 18};
    Blocks found;
    bool hadXmp = false;                // only the first is unpacked: a file may hold thousands
    bool isKnown = false;               // colours stated by a number
    ByteSpan profile, gamma, primaries; // of PNG
    walkChunks(bytes, kind, [&](std::string_view name, ByteSpan data) {
        const bool named = hasText(data, 0, "Exif"); // some programs write a JPEG's header
        if (name == "eXIf") found.exif = data;
        if (name == "EXIF") found.exif = data.subspan(named ? std::min<size_t>(data.size(), 6) : 0);
        if (name == "iTXt" && hasText(data, 0, kXmp) && !std::exchange(hadXmp, true))
            found.xmp = internationalText(data);
        if (name == "XMP ") found.xmp = asText(data);
        if (name == "iCCP" && profile.empty()) profile = data;
        if (name == "ICCP") found.profile = copyOf(data);
        if (name == "colr" && (hasText(data, 0, "prof") || hasText(data, 0, "rICC")))
            found.profile = copyOf(data.subspan(4));
        if (name == "sRGB" || name == "cICP") isKnown = true;
        if (name == "gAMA" && data.size() == 4) gamma = data;
        if (name == "cHRM" && data.size() == 32) primaries = data;
        if (name == "irot" && !data.empty()) found.turns = data[0] & 3;
        if (name == "imir" && !data.empty()) found.mirror = 1 + (data[0] & 1);
    });
    const size_t end = asText(profile).find('\0'); // name 0 method profile
    if (end != std::string_view::npos && profile.size() - end > 2)
        found.profile = unpacked(profile.subspan(end + 2));
    else if (profile.empty() && !isKnown && !(gamma.empty() && primaries.empty()))
        found.profile = statedProfile(gamma, primaries);
    return found;
}

Blocks blocksIn(ByteSpan bytes, PictureKind kind) {
    if (kind == PictureKind::Jpeg) return jpegBlocks(bytes);
    if (kind == PictureKind::Tiff)
        return {bytes, std::string(asText(tiffEntry(bytes, TiffTag::Xmp))),
                copyOf(tiffEntry(bytes, TiffTag::Profile))};
    if (kind == PictureKind::Png || kind == PictureKind::Webp || kind == PictureKind::Avif)
        return chunkBlocks(bytes, kind);
    return {};
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
    constexpr double kLeastShare = 1.0 / 64; // of each side: a small photo may not ask for gigabytes
    if (m.placement && (m.placement->width < m.placement->fullWidth * kLeastShare ||
                        m.placement->height < m.placement->fullHeight * kLeastShare))
        m.placement.reset();
    m.placementIgnored = !m.placement && !xmpValue(xmp, space + "FullPanoWidthPixels").empty();
}

} // namespace

std::string convertToSrgb(ByteSpan bytes, ImageRgb8& picture) {
    constexpr const char* kIgnored = "; its colour profile is damaged or not for its colours, and is ignored";
    if (bytes.empty() || picture.empty()) return "";
    const Profile from(cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    const Profile srgb(cmsCreate_sRGBProfile());
    if (!from || !srgb) return kIgnored;
    const bool grey = cmsGetColorSpace(from.get()) == cmsSigGrayData;
    if (!(grey ? isGrey(picture) : cmsGetColorSpace(from.get()) == cmsSigRgbData)) return kIgnored;
    // A grey transform reads the first of each pixel's three equal components.
    constexpr cmsUInt32Number kFirstOfThree =
        COLORSPACE_SH(PT_GRAY) | CHANNELS_SH(1) | EXTRA_SH(2) | BYTES_SH(1);
    const Transform transform(cmsCreateTransform(from.get(), grey ? kFirstOfThree : TYPE_RGB_8, srgb.get(),
                                                 TYPE_RGB_8, INTENT_RELATIVE_COLORIMETRIC,
                                                 cmsFLAGS_BLACKPOINTCOMPENSATION));
    if (!transform) return kIgnored;
    if (!grey && isIdentity(transform.get())) return "";
    cmsDoTransform(transform.get(), picture.pixels.data(), picture.pixels.data(),
                   static_cast<cmsUInt32Number>(picture.pixels.size() / 3));
    return "; converted to sRGB from the colours that it states";
}

glm::quat PhotoMetadata::envFromPhoto() const {
    return math::rotationAbout({1, 0, 0}, glm::radians(pitch_deg)) *
           math::rotationAbout({0, 0, -1}, glm::radians(roll_deg));
}

std::string PhotoMetadata::note() const {
    std::string text = uprightNote(orientation);
    if (placementIgnored)
        text += "; its place in a panorama contradicts itself or is too small, and is ignored";
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
    constexpr int kTurned[4][3] = {{1, 4, 2}, {8, 5, 7}, {3, 2, 4}, {6, 7, 5}}; // by turns and mirror
    if (kind == PictureKind::Avif) m.orientation = kTurned[found.turns][found.mirror];
    readGPano(found.xmp, m);
    m.profile = std::move(found.profile);
    return m;
}

} // namespace shoal::media
