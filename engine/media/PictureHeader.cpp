#include "engine/media/PictureHeader.h"

#include "engine/core/Number.h"

#include <algorithm>
#include <cctype>
#include <csetjmp>
#include <cstdio>
#include <iterator>
#include <optional>

#include <jpeglib.h> // behind <cstdio>, which it needs

#include <jerror.h>

namespace shoal::media {

namespace {

// Size in pixels; a side of 0: the header cannot be read.
struct Size {
    int64_t width = 0, height = 0;
};

Size jpegSize(ByteSpan b) {
    Size size;
    walkJpeg(b, [&](uint8_t marker, ByteSpan payload) {
        const bool startOfFrame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (startOfFrame && payload.size() >= 5) size = {big16(payload, 3), big16(payload, 1)};
        return startOfFrame;
    });
    return size;
}

Size pngSize(ByteSpan b) {
    if (b.size() < 24 || !hasText(b, 12, "IHDR")) return {};
    return {big32(b, 16), big32(b, 20)};
}

Size bmpSize(ByteSpan b) {
    if (b.size() < 26) return {};
    if (little32(b, 14) == 12) return {little16(b, 18), little16(b, 20)}; // OS/2 1.x
    const auto height = static_cast<int32_t>(little32(b, 22));            // negative: rows from the top
    return {static_cast<int32_t>(little32(b, 18)), height < 0 ? -int64_t{height} : height};
}

// RFC 6386 section 9.1 (VP8), the WebP container specification (VP8L, VP8X).
Size webpSize(ByteSpan b) {
    if (b.size() < 30) return {};
    if (hasText(b, 12, "VP8X")) return {little24(b, 24) + 1, little24(b, 27) + 1};
    if (hasText(b, 12, "VP8L")) {
        const uint32_t packed = little32(b, 21);
        return {(packed & 0x3fff) + 1, (packed >> 14 & 0x3fff) + 1};
    }
    if (hasText(b, 12, "VP8 ")) return {little16(b, 26) & 0x3fff, little16(b, 28) & 0x3fff};
    return {};
}

constexpr std::string_view kTiffBegins[] = {{"II*\0", 4}, {"MM\0*", 4}}; // little and big endian

bool isTiff(ByteSpan b) { return hasText(b, 0, kTiffBegins[0]) || hasText(b, 0, kTiffBegins[1]); }

// Returns whether a TIFF is a camera's raw photo: its first picture is a thumbnail, or it names Adobe's DNG
// or Canon's CR2.
bool isRaw(ByteSpan b) {
    return isTiff(b) && ((tiffNumber(b, TiffTag::SubfileType) & 1) != 0 ||
                         !tiffEntry(b, TiffTag::DngVersion).empty() || hasText(b, 8, "CR"));
}

// TIFF 6.0. The library takes memory for a whole tile or strip, whatever the picture's size.
Size tiffSize(ByteSpan b) {
    constexpr uint64_t kMaxTile = 1 << 24; // pixels
    const uint64_t width = tiffNumber(b, TiffTag::Width), height = tiffNumber(b, TiffTag::Height);
    const uint64_t rows = tiffNumber(b, TiffTag::RowsPerStrip);
    const bool largeStrip = rows > height && rows != UINT32_MAX && rows * width > kMaxTile;
    const bool largeTile =
        uint64_t{tiffNumber(b, TiffTag::TileWidth)} * tiffNumber(b, TiffTag::TileHeight) > kMaxTile;
    if (largeStrip || largeTile) return {};
    return {static_cast<int64_t>(width), static_cast<int64_t>(height)};
}

// Returns the next number in the text of a PNM or PFM header, past white space and comments; 0: none.
int64_t nextNumber(ByteSpan b, size_t& at) {
    while (at < b.size() && (std::isspace(b[at]) || b[at] == '#')) {
        if (b[at] == '#')
            while (at < b.size() && b[at] != '\n') ++at;
        else
            ++at;
    }
    const size_t begin = at;
    while (at < b.size() && std::isdigit(b[at]) && at - begin < 9) ++at;
    return parseNumber<int64_t>(asText(b.subspan(begin, at - begin))).value_or(0);
}

Size pnmSize(ByteSpan b) {
    size_t at = 2;
    const int64_t width = nextNumber(b, at);
    return {width, nextNumber(b, at)};
}

// Radiance: header lines, an empty line, then "-Y height +X width"; other orientations are not read.
Size radianceSize(ByteSpan b) {
    const std::string_view text = asText(b.first(std::min<size_t>(b.size(), 64 << 10)));
    const size_t empty = text.find("\n\n");
    if (empty == text.npos || !hasText(b, empty + 2, "-Y ")) return {};
    size_t at = empty + 5;
    const int64_t height = nextNumber(b, at);
    if (!hasText(b, at, " +X ")) return {};
    at += 4;
    return {nextNumber(b, at), height};
}

// Returns whether a value has the size of its type: the library reads as many bytes as the type has, whatever
// size is stated, and takes what follows for the next attribute.
bool exrSizeFits(std::string_view type, ByteSpan value) {
    using Type = std::pair<std::string_view, size_t>;
    static constexpr Type kTypes[] = {
        {"compression", 1}, {"deepImageState", 1}, {"envmap", 1},   {"lineOrder", 1}, {"float", 4},
        {"int", 4},         {"double", 8},         {"rational", 8}, {"timecode", 8},  {"v2f", 8},
        {"v2i", 8},         {"tiledesc", 9},       {"v3f", 12},     {"v3i", 12},      {"box2f", 16},
        {"box2i", 16},      {"v2d", 16},           {"v3d", 24},     {"keycode", 28},  {"chromaticities", 32},
        {"m33f", 36},       {"m44f", 64},          {"m33d", 72},    {"m44d", 128}};
    const auto* known = std::ranges::find(kTypes, type, &Type::first);
    if (known != std::end(kTypes)) return value.size() == known->second;
    if (type == "chlist") { // "name\0" and 16 bytes each, up to an empty name
        size_t at = 0;
        while (at < value.size() && value[at] != 0) {
            at = asText(value).find('\0', at);
            if (at == std::string_view::npos || value.size() - at < 18) return false;
            at += 17;
        }
        return at + 1 == value.size();
    }
    if (type == "preview")
        return value.size() >= 8 && value.size() - 8 == uint64_t{4} * little32(value, 0) * little32(value, 4);
    return type != "stringvector" && type != "idmanifest"; // contain sizes themselves; no picture needs them
}

// OpenEXR file layout: attributes "name\0 type\0 size value" up to an empty name. All of them are walked: the
// library takes memory for any size that one states.
Size exrSize(ByteSpan b) {
    if (b.size() < 8 || (little32(b, 4) & 0x1800) != 0) return {}; // deep or of several parts
    const std::string_view text = asText(b);
    size_t at = 8;
    std::optional<Size> window;
    for (int attribute = 0; attribute < 256; ++attribute) {
        const size_t nameEnd = text.find('\0', at);
        if (nameEnd == text.npos) break;
        if (nameEnd == at) return window.value_or(Size());
        const size_t typeEnd = text.find('\0', nameEnd + 1);
        if (typeEnd == text.npos || b.size() - typeEnd < 5) break;
        const size_t value = typeEnd + 5;
        const size_t size = little32(b, typeEnd + 1);
        if (size > b.size() - value) break;
        if (!exrSizeFits(text.substr(nameEnd + 1, typeEnd - nameEnd - 1), b.subspan(value, size))) break;
        if (text.substr(at, nameEnd - at) == "dataWindow" && size == 16) {
            const auto side = [&](size_t offset) {
                return int64_t{static_cast<int32_t>(little32(b, value + offset))};
            };
            if (window) break; // two data windows are ambiguous
            window = Size{side(8) - side(0) + 1, side(12) - side(4) + 1};
        }
        at = value + size;
    }
    return {};
}

bool isPnm(ByteSpan b) {
    return b.size() > 2 && b[0] == 'P' && b[1] >= '1' && b[1] <= '6' && std::isspace(b[2]);
}

// Returns whether a file of the ISO base media format (ISO 14496-12, 4.3) names one of these brands, of four
// letters each.
bool hasBrand(ByteSpan b, std::string_view brands) {
    if (b.size() < 12 || !hasText(b, 4, "ftyp")) return false;
    const size_t end = std::min<size_t>({big32(b, 0), b.size(), 256});
    for (size_t at = 8; at + 4 <= end; at += at == 8 ? 8 : 4) // a version follows the first brand
        if (brands.find(asText(b.subspan(at, 4))) != brands.npos) return true;
    return false;
}

// Returns the largest size that a picture in the file states by a box "ispe" (ISO 23008-12, 6.5.3): parts and
// thumbnails are smaller than the whole.
Size avifSize(ByteSpan b) {
    const std::string_view text = asText(b);
    Size size;
    for (size_t at = text.find("ispe"); at != text.npos && b.size() - at >= 16;
         at = text.find("ispe", at + 4))
        if (const Size one{big32(b, at + 8), big32(b, at + 12)}; one.width > size.width) size = one;
    return size;
}

struct Kind {
    const char* name;
    bool (*is)(ByteSpan);
    Size (*size)(ByteSpan);
};
// Kinds of pictures, indexed by PictureKind.
constexpr Kind kKinds[] = {
    {"JPEG", [](ByteSpan b) { return hasText(b, 0, "\xff\xd8\xff"); }, jpegSize},
    {"PNG", [](ByteSpan b) { return hasText(b, 0, "\x89PNG\r\n\x1a\n"); }, pngSize},
    {"BMP", [](ByteSpan b) { return hasText(b, 0, "BM"); }, bmpSize},
    {"WebP", [](ByteSpan b) { return hasText(b, 0, "RIFF") && hasText(b, 8, "WEBP"); }, webpSize},
    {"TIFF", [](ByteSpan b) { return isTiff(b) && !isRaw(b); }, tiffSize},
    {"AVIF", [](ByteSpan b) { return hasBrand(b, "avif avis"); }, avifSize},
    {"PNM", isPnm, pnmSize},
    {"Radiance HDR", [](ByteSpan b) { return hasText(b, 0, "#?RADIANCE") || hasText(b, 0, "#?RGBE"); },
     radianceSize},
    {"OpenEXR", [](ByteSpan b) { return hasText(b, 0, "\x76\x2f\x31\x01"); }, exrSize},
    {"PFM", [](ByteSpan b) { return hasText(b, 0, "PF") || hasText(b, 0, "Pf"); }, pnmSize},
};

struct JpegErrors : jpeg_error_mgr {
    std::jmp_buf failed{};
    bool cut = false; // the data of a scan ended early
};

// Returns whether a component has no scan, or a progressive one lacks its last bits.
bool lacksScans(const jpeg_decompress_struct& jpeg) {
    for (int c = 0; c < jpeg.num_components; ++c) {
        if (!jpeg.comp_info[c].quant_table) return true; // set by the component's first scan
        if (!jpeg.progressive_mode) continue;
        const auto& missing = jpeg.coef_bits[c]; // bits of each coefficient that are not known; -1: none is
        if (std::ranges::any_of(missing, [](int bits) { return bits != 0; })) return true;
    }
    return false;
}

} // namespace

size_t walkJpeg(ByteSpan b, const std::function<bool(uint8_t marker, ByteSpan payload)>& visit) {
    size_t at = 2;
    while (at + 4 <= b.size()) {
        if (b[at] != 0xff) break;
        const uint8_t marker = b[at + 1];
        if (marker == 0xff) { // fill byte
            ++at;
            continue;
        }
        if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) { // markers without payload
            at += 2;
            continue;
        }
        const size_t length = big16(b, at + 2);
        if (marker == 0xd9 || length < 2 || length > b.size() - at - 2) break;
        if (visit(marker, b.subspan(at + 4, length - 2))) break;
        at += 2 + length;
        if (marker == 0xda) break;
    }
    return at;
}

const char* nameOf(PictureKind kind) { return kKinds[static_cast<size_t>(kind)].name; }

bool isHdr(PictureKind kind) { return kind >= PictureKind::Radiance; }

Result<PictureKind> pictureKind(ByteSpan bytes) {
    const auto kind = std::ranges::find_if(kKinds, [&](const Kind& each) { return each.is(bytes); });
    if (const char* unread = kind == std::end(kKinds) ? unreadKind(bytes) : nullptr)
        return Error{"", std::string("is a ") + unread + " picture; convert it to JPEG"};
    if (kind == std::end(kKinds))
        return Error{
            "", "is not a picture of a known kind (JPEG, PNG, BMP, WebP, TIFF, AVIF, PNM, HDR, EXR, PFM)"};
    return static_cast<PictureKind>(kind - kKinds);
}

const char* unreadKind(ByteSpan bytes) {
    using Begin = std::pair<const char*, std::string_view>;
    static constexpr Begin kBegins[] = {{"GIF", "GIF8"},
                                        {"JPEG XL", "\xff\x0a"},
                                        {"JPEG 2000", "\xff\x4f"},
                                        {"JPEG XL", {"\0\0\0\x0cJXL ", 8}},
                                        {"Photoshop", "8BPS"},
                                        {"JPEG 2000", {"\0\0\0\x0cjP  ", 8}},
                                        {"camera raw", "FUJIFILM"},
                                        {"camera raw", "IIRO"},
                                        {"camera raw", "IIRS"},
                                        {"camera raw", "MMOR"},
                                        {"camera raw", {"IIU\0", 4}},
                                        {"camera raw", "FOVb"},
                                        {"camera raw", {"\0MRM", 4}}};
    if (hasBrand(bytes, "heic heix heim heis hevc hevx mif1 msf1")) return "HEIC";
    if (isRaw(bytes) || hasBrand(bytes, "crx ")) return "camera raw";
    const auto known =
        std::ranges::find_if(kBegins, [&](const Begin& each) { return hasText(bytes, 0, each.second); });
    return known == std::end(kBegins) ? nullptr : known->first;
}

Result<PictureHeader> readPictureHeader(ByteSpan bytes) {
    const auto kind = pictureKind(bytes);
    if (!kind) return kind.error();
    const Size size = kKinds[static_cast<size_t>(*kind)].size(bytes);
    if (size.width <= 0 || size.height <= 0)
        return Error{"", std::string("its ") + nameOf(*kind) +
                             " header is damaged, cut short or of an unread variant"};
    return PictureHeader{*kind, size.width, size.height};
}

bool lacksEndMark(ByteSpan jpeg) {
    const size_t data = walkJpeg(jpeg, [](uint8_t, ByteSpan) { return false; });
    return asText(jpeg.subspan(std::min(data, jpeg.size()))).find("\xff\xd9") == std::string_view::npos;
}

bool isCutJpeg(ByteSpan bytes) {
    JpegErrors errors;
    jpeg_decompress_struct jpeg{};
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = [](j_common_ptr common) {
        std::longjmp(static_cast<JpegErrors*>(common->err)->failed, 1);
    };
    errors.emit_message = [](j_common_ptr common, int) {
        if (common->err->msg_code == JWRN_HIT_MARKER) static_cast<JpegErrors*>(common->err)->cut = true;
    };
    if (setjmp(errors.failed) == 0) {
        jpeg_create_decompress(&jpeg);
        jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
        jpeg_read_header(&jpeg, TRUE);
        jpeg.scale_denom = 8; // a pixel of each block: the entropy-coded data alone matter
        jpeg_start_decompress(&jpeg);
        JSAMPARRAY row = jpeg.mem->alloc_sarray(reinterpret_cast<j_common_ptr>(&jpeg), JPOOL_IMAGE,
                                                jpeg.output_width * jpeg.output_components, 1);
        while (jpeg.output_scanline < jpeg.output_height) jpeg_read_scanlines(&jpeg, row, 1);
        errors.cut = errors.cut || lacksScans(jpeg);
    } else {
        errors.cut = true;
    }
    jpeg_destroy_decompress(&jpeg);
    return errors.cut;
}

ByteSpan tiffEntry(ByteSpan b, TiffTag tag) {
    const bool little = hasText(b, 0, kTiffBegins[0]);
    if (b.size() < 8 || (!little && !hasText(b, 0, kTiffBegins[1]))) return {};
    const auto word = [&](size_t at) { return little ? little16(b, at) : big16(b, at); };
    const auto number = [&](size_t at) { return little ? little32(b, at) : big32(b, at); };
    const size_t directory = number(4);
    if (directory > b.size() || b.size() - directory < 2) return {};
    const size_t entries = std::min<size_t>(word(directory), (b.size() - directory - 2) / 12);
    for (size_t at = directory + 2; at < directory + 2 + 12 * entries; at += 12) { // tag, type, count, data
        if (word(at) != static_cast<uint32_t>(tag)) continue;
        static constexpr size_t kSizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8}; // by type
        const size_t type = word(at + 2);
        const uint64_t size = uint64_t{number(at + 4)} * (type < std::size(kSizes) ? kSizes[type] : 0);
        const size_t begin = size <= 4 ? at + 8 : number(at + 8);
        return begin <= b.size() && size <= b.size() - begin ? b.subspan(begin, size) : ByteSpan();
    }
    return {};
}

uint32_t tiffNumber(ByteSpan b, TiffTag tag) {
    const ByteSpan value = tiffEntry(b, tag);
    const bool little = hasText(b, 0, kTiffBegins[0]);
    if (value.size() == 2) return little ? little16(value, 0) : big16(value, 0);
    if (value.size() == 4) return little ? little32(value, 0) : big32(value, 0);
    return 0;
}

} // namespace shoal::media
