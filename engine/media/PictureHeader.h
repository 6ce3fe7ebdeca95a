// What kind of picture a file holds and how large it is, from its first bytes, before anything is decoded.
#pragma once

#include "engine/core/Result.h"

#include <cstdint>
#include <span>

namespace shoal::media {

enum class PictureKind { Jpeg, Png, Bmp, Webp, Pnm, Radiance, Exr, Pfm };

const char* nameOf(PictureKind kind);
bool isHdr(PictureKind kind);

struct PictureHeader {
    PictureKind kind = PictureKind::Png;
    int64_t width = 0; // as stored, before any EXIF rotation; above 0
    int64_t height = 0;
};

// bytes: the file or at least its beginning (a JPEG's size may follow long metadata). The error has no path.
Result<PictureHeader> readPictureHeader(std::span<const uint8_t> bytes);

// What is missing from a PNG or JPEG that was cut short or altered, so that its decoder need not find out;
// empty if nothing is. PNG: every chunk and its checksum; JPEG: the end mark.
const char* damageIn(PictureKind kind, std::span<const uint8_t> bytes);

} // namespace shoal::media
