// Kind and size of a picture file from its first bytes, so that limits hold before memory is taken. Read
// here: stb_image knows neither WebP nor PFM, and OpenCV decodes to tell a size. Internal to this folder.
#pragma once

#include "engine/core/Result.h"
#include "engine/media/Pictures.h"

#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string_view>

namespace shoal::media {

// Integers and text in byte strings. The caller has checked that the bytes are there.
using ByteSpan = std::span<const uint8_t>;

inline uint32_t big16(ByteSpan b, size_t at) { return uint32_t{b[at]} << 8 | b[at + 1]; }
inline uint32_t big32(ByteSpan b, size_t at) { return big16(b, at) << 16 | big16(b, at + 2); }
inline uint64_t big64(ByteSpan b, size_t at) { return uint64_t{big32(b, at)} << 32 | big32(b, at + 4); }
inline uint32_t little16(ByteSpan b, size_t at) { return uint32_t{b[at + 1]} << 8 | b[at]; }
inline uint32_t little24(ByteSpan b, size_t at) { return uint32_t{b[at + 2]} << 16 | little16(b, at); }
inline uint32_t little32(ByteSpan b, size_t at) { return little16(b, at + 2) << 16 | little16(b, at); }

// Returns whether the text lies at this offset; false also if the bytes end before.
inline bool hasText(ByteSpan b, size_t at, std::string_view text) {
    return b.size() >= at && b.size() - at >= text.size() &&
           std::memcmp(b.data() + at, text.data(), text.size()) == 0;
}

inline std::string_view asText(ByteSpan b) { return {reinterpret_cast<const char*>(b.data()), b.size()}; }

enum class PictureKind { Jpeg, Png, Bmp, Webp, Tiff, Avif, Pnm, Radiance, Exr, Pfm };

const char* nameOf(PictureKind kind);
bool isHdr(PictureKind kind);

// Size in pixels; a side of 0: the header cannot be read.
struct PictureSize {
    int64_t width = 0, height = 0;
};

// Returns a clause that says which limit the size is above; empty: none.
std::string beyond(PictureSize size, PictureLimits limits);

// Header of a Radiance picture (Radiance's filefmts.pdf, "Picture File Format").
struct RadianceHeader {
    PictureSize size;                       // as stored: pixels of a line, lines
    int orientation = 1;                    // SphericalMetadata.h
    std::array<float, 3> exposure{1, 1, 1}; // what radiance was multiplied with: EXPOSURE, COLORCORR
    float gamma = 1;                        // not in Radiance, but in Walter's rgbe.c
    bool squarePixels = true;
    std::optional<Primaries> primaries;
    size_t pixels = 0; // their offset, bytes
};
RadianceHeader readRadianceHeader(ByteSpan bytes);

// Header of a portable float map: "PF" (RGB), "Pf" (grey) or "PF4" (RGBA), size, scale.
struct PfmHeader {
    PictureSize size;
    size_t channels = 0;
    float scale = 0;   // negative: little endian. Its size is a factor: Paul Debevec's definition
    size_t pixels = 0; // their offset, bytes
};
PfmHeader readPfmHeader(ByteSpan bytes);

struct PictureHeader {
    PictureKind kind = PictureKind::Png;
    PictureSize size; // as stored, before any rotation; above 0; 1 for OpenEXR, whose size decodeExr() checks
};

// Reads the kind alone, from the first bytes. The error has no path.
Result<PictureKind> pictureKind(ByteSpan bytes);

// Returns the name of a kind of picture that is not read, such as "HEIC"; null: none that is known.
const char* unreadKind(ByteSpan bytes);

// bytes: the file or at least its beginning (a JPEG's size may follow long metadata, a TIFF's the pixels).
// The error has no path.
Result<PictureHeader> readPictureHeader(ByteSpan bytes);

// Returns whether a JPEG has no end mark and lacks parts of the picture too, which libjpeg would fill with
// grey. Decodes it if the mark is missing.
bool isCutJpeg(ByteSpan jpeg);

// Calls visit(marker, payload) for each segment of a JPEG (ITU T.81 annex B) until it returns true or the
// compressed data begins. Returns the offset reached.
size_t walkJpeg(ByteSpan bytes, const std::function<bool(uint8_t marker, ByteSpan payload)>& visit);

// Calls visit(name, data) for each chunk of a PNG (size, name, data, checksum) or a WebP (name, size, data),
// or each box of an AVIF (size, name, data), also for those that describe its pictures (ISO 23008-12, 9.3).
void walkChunks(ByteSpan bytes, PictureKind kind,
                const std::function<void(std::string_view name, ByteSpan data)>& visit);

enum class TiffTag : uint32_t {
    SubfileType = 254,
    Width = 256,
    Height = 257,
    Orientation = 274,
    RowsPerStrip = 278,
    TileWidth = 322,
    TileHeight = 323,
    Xmp = 700,
    Profile = 34675,
    DngVersion = 50706
};

// Return the data of a tag in the first directory of a TIFF structure, which EXIF has too (TIFF 6.0, section
// 2), or its one number, at most 2^32 - 1; empty or 0 if it is missing or cut short. bytes: the structure.
ByteSpan tiffEntry(ByteSpan bytes, TiffTag tag);
uint32_t tiffNumber(ByteSpan bytes, TiffTag tag);

} // namespace shoal::media
