// Reading and writing of picture files. Any thread may call these functions.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/PhotoMetadata.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace shoal::media {

// Largest sizes; checked against the file's header before memory is allocated for the pixels.
struct PictureLimits {
    int maxWidth = 16384;
    int maxHeight = 8192;
};

struct Photo {
    ImageRgb8 picture; // sRGB-coded, red first, without transparency; upright, its stated colours converted
    PhotoMetadata metadata;
    std::string colourNote = {}; // convertToSrgb()

    // Returns what was done to the picture and what its metadata ask for, a clause each after "; ".
    std::string note() const { return colourNote + metadata.note(); }
};

// Reads JPEG, PNG, BMP, WebP, TIFF, AVIF, PNM. The content decides the kind, not the name.
Result<Photo> readPhoto(const Path& file, PictureLimits limits = {});

// CIE x and y of red, green, blue and white.
using Primaries = std::array<float, 8>;

struct HdrPicture {
    ImageRgbF radianceLin;                   // linear, Rec. 709 primaries; no exposure applied
    std::optional<Primaries> primaries = {}; // as stated, and converted from; empty: Rec. 709 assumed
    std::vector<std::string> notes = {};     // clauses: which part of the file it is, what was done to it

    // Returns the notes, each after "; ".
    std::string note() const;
};

// The sun's disc is about 1e9 cd/m^2, and sums of squares of this stay finite in 32 bits.
constexpr float kMaxRadiance = 1e9f;

constexpr const char* kNoLayers = "has no layers; leave --layer out";

// Reads Radiance RGBE, OpenEXR (colour or grey) and PFM (colour, with alpha or grey). Values above the half-
// float limit 65504 are kept. layer: one of an OpenEXR file, by its channels' names ("diffuse" of
// "diffuse.R"), or its part's name; empty: the channels without a layer, else the only layer with colour, of
// the first part and view. Components that are NaN or negative become 0, infinite ones become the file's
// largest finite one, and those above kMaxRadiance become kMaxRadiance.
Result<HdrPicture> readHdr(const Path& file, PictureLimits limits = {}, const std::string& layer = {});

// Write a lossless file, which appears whole or not at all (engine/core/WriteFile.h).
Status writePng(const Path& file, const ImageRgb8& image);
Status writePng(const Path& file, const ImageRgba8& image);

// Format of a picture file by its extension, in upper or lower case.
enum class WrittenAs { Nothing, Png, Jpeg, Hdr };
WrittenAs writtenAs(const Path& file);

// Writes PNG or JPEG (quality 95) by extension, whole or not at all.
Status writePicture(const Path& file, const ImageRgb8& image);

// Encodes by extension: .pfm (exact), .exr (32-bit float, exact), .hdr (RGBE: shared exponent, error up to
// 1/256 of the pixel's largest component). encodeHdr returns the file's bytes; writeHdr writes a whole file.
Result<std::string> encodeHdr(const Path& name, const ImageRgbF& radianceLin);
Status writeHdr(const Path& file, const ImageRgbF& radianceLin);

// Copies a picture to blue, green, red and alpha 255; fits `out` to its size. bgr: blue comes first in `in`.
void toBgra(const ImageRgb8& in, bool bgr, ImageRgba8& out);

} // namespace shoal::media
