// Kind of a film's or picture's file by its content, for every command, for files dropped on the window and
// for lists of files.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <string>

namespace shoal::media {

// Photo: coded; Hdr: a high dynamic range picture.
enum class MediaKind { Photo, Hdr, Video, DepthTrack };

// Reads some kilobytes, and of a video its container's headers; the name does not matter. The error says what
// else the file is ("is a HEIC picture; convert it to JPEG", "is only sound"), as far as its content tells. A
// file whose kind is known may still be damaged. layer: if it is not empty, only OpenEXR is right.
Result<MediaKind> mediaKind(const Path& file, const std::string& layer = {});

} // namespace shoal::media
