#include "engine/media/PictureHeader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <csetjmp>
#include <cstdio>
#include <iterator>
#include <sstream>

#include <jpeglib.h> // behind <cstdio>, which it needs

#include <jerror.h>

namespace shoal::media {

namespace {

using namespace std::string_view_literals;
using Size = PictureSize;

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

// Little and big endian.
bool isTiff(ByteSpan b) { return hasText(b, 0, "II*\0"sv) || hasText(b, 0, "MM\0*"sv); }

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

std::istringstream beginOf(ByteSpan bytes) {
    return std::istringstream(std::string(asText(bytes.first(std::min<size_t>(bytes.size(), 64 << 10)))));
}

Size pnmSize(ByteSpan b) {
    std::istringstream text = beginOf(b.subspan(2));
    Size size;
    for (int64_t* side : {&size.width, &size.height}) {
        while ((text >> std::ws).peek() == '#') text.ignore(INT64_MAX, '\n');
        text >> *side;
    }
    return size;
}

// Applies a line "NAME=value" of a Radiance header. False: its value is damaged.
bool readRadianceLine(const std::string& line, RadianceHeader& header) {
    const size_t equals = std::min(line.find('='), line.size());
    const std::string name = line.substr(0, equals);
    std::istringstream value(line.substr(std::min(equals + 1, line.size())));
    if (name == "FORMAT") {
        const bool isXyz = line.ends_with("32-bit_rle_xyze"); // equal energy is white, as in Radiance
        if (isXyz) header.primaries = {1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
        return isXyz || line.ends_with("32-bit_rle_rgbe");
    }
    const size_t count = name == "EXPOSURE" || name == "PIXASPECT" || name == "GAMMA" ? 1
                         : name == "COLORCORR"                                        ? 3
                         : name == "PRIMARIES"                                        ? 8
                                                                                      : 0;
    if (count == 0) return true;
    const std::vector<float> numbers{std::istream_iterator<float>(value), {}};
    if (numbers.size() != count || !value.eof()) return false;
    if (name == "GAMMA") header.gamma = numbers[0];
    if (name == "PIXASPECT") header.squarePixels = numbers[0] == 1;
    if (name == "PRIMARIES") std::ranges::copy(numbers, header.primaries.emplace().begin());
    if (name == "EXPOSURE" || name == "COLORCORR")
        for (size_t c = 0; c < 3; ++c) header.exposure[c] *= numbers[std::min(c, count - 1)];
    return true;
}

// Reads the resolution line, such as "-Y 512 +X 1024": the axis from line to line, then that along a line.
bool readResolution(const std::string& line, RadianceHeader& header) {
    constexpr std::string_view kOrders[] = {"-Y+X", "-Y-X", "+Y-X", "+Y+X", "+X-Y", "-X-Y", "-X+Y", "+X+Y"};
    std::istringstream words(line);
    std::string lines, along;
    words >> lines >> header.size.height >> along >> header.size.width;
    const auto order = std::ranges::find(kOrders, lines + along);
    header.orientation = static_cast<int>(order - kOrders) + 1;
    return words && order != std::end(kOrders) && (words >> std::ws).eof();
}

Size radianceSize(ByteSpan b) {
    const RadianceHeader header = readRadianceHeader(b);
    const Size stored = header.size;
    return swapsSides(header.orientation) ? Size{stored.height, stored.width} : stored;
}

bool isEndedWord(ByteSpan b, std::string_view word) {
    return hasText(b, 0, word) && b.size() > word.size() && std::isspace(b[word.size()]);
}

bool isPnm(ByteSpan b) {
    return b.size() > 2 && b[0] == 'P' && b[1] >= '1' && b[1] <= '6' && std::isspace(b[2]);
}

// Returns whether an ISO base media file (ISO 14496-12, 4.3) names one of these brands of four letters.
bool hasBrand(ByteSpan b, std::string_view brands) {
    if (b.size() < 12 || !hasText(b, 4, "ftyp")) return false;
    const size_t end = std::min<size_t>({big32(b, 0), b.size(), 256});
    for (size_t at = 8; at + 4 <= end; at += at == 8 ? 8 : 4) // a version follows the first brand
        if (brands.find(asText(b.subspan(at, 4))) != brands.npos) return true;
    return false;
}

// Returns the largest size that a picture states (ISO 23008-12, 6.5.3): parts and thumbnails are smaller.
Size avifSize(ByteSpan b) {
    Size size;
    walkChunks(b, PictureKind::Avif, [&](std::string_view name, ByteSpan data) {
        if (name == "ispe" && data.size() >= 12 && big32(data, 4) > size.width)
            size = {big32(data, 4), big32(data, 8)};
    });
    return size;
}

Size exrSize(ByteSpan) { return {1, 1}; } // OpenExr.cpp reads it

struct Kind {
    const char* name;
    bool (*is)(ByteSpan);
    Size (*size)(ByteSpan);
};
// Kinds of pictures, indexed by PictureKind.
constexpr Kind kKinds[] = {
    {"JPEG", [](ByteSpan b) { return hasText(b, 0, "\xff\xd8\xff"); }, jpegSize},
    {"PNG", [](ByteSpan b) { return hasText(b, 0, "\x89PNG\r\n\x1a\n"); }, pngSize},
    {"BMP",
     [](ByteSpan b) {
         return hasText(b, 0, "BM") && b.size() >= 18 && little32(b, 14) >= 12 && little32(b, 14) <= 124;
     },
     bmpSize},
    {"WebP", [](ByteSpan b) { return hasText(b, 0, "RIFF") && hasText(b, 8, "WEBP"); }, webpSize},
    {"TIFF", [](ByteSpan b) { return isTiff(b) && !isRaw(b); }, tiffSize},
    {"AVIF", [](ByteSpan b) { return hasBrand(b, "avif avis"); }, avifSize},
    {"PNM", isPnm, pnmSize},
    {"Radiance HDR", [](ByteSpan b) { return hasText(b, 0, "#?RADIANCE") || hasText(b, 0, "#?RGBE"); },
     radianceSize},
    {"OpenEXR", [](ByteSpan b) { return hasText(b, 0, "\x76\x2f\x31\x01"); }, exrSize},
    {"PFM", [](ByteSpan b) { return isEndedWord(b, "PF") || isEndedWord(b, "Pf") || isEndedWord(b, "PF4"); },
     [](ByteSpan b) { return readPfmHeader(b).size; }},
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
    while (at + 4 <= b.size() && b[at] == 0xff) {
        const uint8_t marker = b[at + 1];
        const bool isAlone = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7); // without payload
        if (isAlone || marker == 0xff) {                                           // 0xff: fill byte
            at += isAlone ? 2 : 1;
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

void walkChunks(ByteSpan b, PictureKind kind,
                const std::function<void(std::string_view name, ByteSpan data)>& visit) {
    const bool png = kind == PictureKind::Png, webp = kind == PictureKind::Webp;
    for (size_t at = png ? 8 : webp ? 12 : 0; at < b.size() && b.size() - at >= 8;) {
        const std::string_view name = asText(b.subspan(webp ? at : at + 4, 4));
        const bool holdsBoxes =
            kind == PictureKind::Avif && (name == "meta" || name == "iprp" || name == "ipco");
        at += 8;
        if (holdsBoxes) {
            at += name == "meta" ? 4 : 0; // version and flags
            continue;
        }
        const size_t size = png    ? big32(b, at - 8)
                            : webp ? little32(b, at - 4)
                                   : size_t{big32(b, at - 8)} - 8;
        if (size > b.size() - at) return;
        visit(name, b.subspan(at, size));
        at += size + (png ? 4 : webp ? size & 1 : 0); // a checksum; or to an even offset
    }
}

const char* nameOf(PictureKind kind) { return kKinds[static_cast<size_t>(kind)].name; }

bool isHdr(PictureKind kind) { return kind >= PictureKind::Radiance; }

RadianceHeader readRadianceHeader(ByteSpan bytes) {
    std::istringstream text = beginOf(bytes);
    RadianceHeader header;
    bool wasEmpty = false;
    for (std::string line; std::getline(text, line) && !text.eof();) {
        line.erase(line.find_last_not_of(" \t\r") + 1);
        if (!(wasEmpty ? readResolution(line, header) : readRadianceLine(line, header))) break;
        header.pixels = static_cast<size_t>(text.tellg());
        if (wasEmpty) return header;
        wasEmpty = line.empty();
    }
    return {};
}

PfmHeader readPfmHeader(ByteSpan bytes) {
    std::istringstream text = beginOf(bytes);
    std::string kind;
    PfmHeader header;
    text >> kind >> header.size.width >> header.size.height >> header.scale;
    const int behind = text.peek();
    text.ignore(behind == '\r' ? 2 : 1);
    if (!text || !std::isspace(behind) || header.scale == 0) return {};
    header.channels = kind == "PF4" ? 4 : kind == "PF" ? 3 : 1;
    header.pixels = static_cast<size_t>(text.tellg());
    return header;
}

std::string beyond(PictureSize size, PictureLimits limits) {
    if (size.width <= limits.maxWidth && size.height <= limits.maxHeight) return "";
    return fmt::format("its {}x{} pixels are more than the limit of {}x{}", size.width, size.height,
                       limits.maxWidth, limits.maxHeight);
}

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
    const auto begins = [&](auto... texts) { return (hasText(bytes, 0, texts) || ...); };
    if (hasBrand(bytes, "heic heix heim heis hevc hevx mif1 msf1")) return "HEIC";
    if (isRaw(bytes) || hasBrand(bytes, "crx ") ||
        begins("FUJIFILM", "IIRO", "IIRS", "MMOR", "IIU\0"sv, "FOVb", "\0MRM"sv))
        return "camera raw";
    if (begins("\xff\x0a", "\0\0\0\x0cJXL "sv)) return "JPEG XL";
    if (begins("\xff\x4f", "\0\0\0\x0cjP  "sv)) return "JPEG 2000";
    if (begins("II+\0"sv, "MM\0+"sv)) return "BigTIFF";
    return begins("GIF8") ? "GIF" : begins("8BPS") ? "Photoshop" : nullptr;
}

Result<PictureHeader> readPictureHeader(ByteSpan bytes) {
    const auto kind = pictureKind(bytes);
    if (!kind) return kind.error();
    const Size size = kKinds[static_cast<size_t>(*kind)].size(bytes);
    if (size.width <= 0 || size.height <= 0)
        return Error{"", std::string("its ") + nameOf(*kind) +
                             " header is damaged, cut short or of an unread variant"};
    return PictureHeader{*kind, size};
}

bool isCutJpeg(ByteSpan bytes) {
    const size_t data = walkJpeg(bytes, [](uint8_t, ByteSpan) { return false; });
    if (asText(bytes.subspan(std::min(data, bytes.size()))).find("\xff\xd9") != std::string_view::npos)
        return false;
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
        errors.cut = errors.cut || jpeg.arith_code || lacksScans(jpeg); // arithmetic codes end in any zeros
    } else {
        errors.cut = true;
    }
    jpeg_destroy_decompress(&jpeg);
    return errors.cut;
}

// Returns a number of at most 8 bytes.
static uint64_t numberIn(ByteSpan bytes, bool little) {
    uint64_t number = 0;
    for (size_t i = 0; i < bytes.size(); ++i) number = number << 8 | bytes[little ? bytes.size() - 1 - i : i];
    return number;
}

ByteSpan tiffEntry(ByteSpan b, TiffTag tag) {
    if (b.size() < 8 || !isTiff(b)) return {};
    const auto number = [&](size_t at, size_t bytes) { return numberIn(b.subspan(at, bytes), b[0] == 'I'); };
    const size_t directory = number(4, 4);
    if (directory > b.size() || b.size() - directory < 2) return {};
    const size_t entries = std::min<size_t>(number(directory, 2), (b.size() - directory - 2) / 12);
    for (size_t at = directory + 2; at < directory + 2 + 12 * entries; at += 12) { // tag, type, count, data
        if (number(at, 2) != static_cast<uint32_t>(tag)) continue;
        // Bytes of a value by its type; libtiff reads BigTIFF's types from 16 on in any file.
        static constexpr size_t kSizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
        const size_t type = number(at + 2, 2);
        const size_t size = number(at + 4, 4) * (type < std::size(kSizes) ? kSizes[type] : 0);
        const size_t begin = size <= 4 ? at + 8 : number(at + 8, 4);
        return begin <= b.size() && size <= b.size() - begin ? b.subspan(begin, size) : ByteSpan();
    }
    return {};
}

uint32_t tiffNumber(ByteSpan b, TiffTag tag) {
    const ByteSpan value = tiffEntry(b, tag);
    if (value.empty() || value.size() > 8) return 0;
    return static_cast<uint32_t>(std::min<uint64_t>(numberIn(value, b[0] == 'I'), UINT32_MAX));
}

} // namespace shoal::media
