// Kind and size of a picture file, read from its first bytes so that limits hold before memory is taken.
// Read here because stb_image knows neither WebP, OpenEXR nor PFM, and OpenCV tells a size only by decoding.
#pragma once

#include "engine/core/Result.h"
#include "engine/media/Bytes.h"

#include <functional>

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
Result<PictureHeader> readPictureHeader(ByteSpan bytes);

// Why a PNG or JPEG is cut short or altered; empty if it is neither. PNG: every chunk and its checksum; JPEG:
// the end mark. Tested before decoding, because libpng and libjpeg write to standard error.
const char* damageIn(PictureKind kind, ByteSpan bytes);

// Calls visit(marker, payload) for each segment of a JPEG (ITU T.81 annex B) until it returns true or the
// compressed data begins. Returns the offset reached.
size_t walkJpeg(ByteSpan bytes, const std::function<bool(uint8_t marker, ByteSpan payload)>& visit);

} // namespace shoal::media
