// Kind of a media file by its content, for every command, for files dropped on the window and for lists of
// files; and one-line descriptions of video, picture and depth files for `shoal check`.
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

// Returns a description ("2048x1024 h264 video, ..."), also of the depth track beside the file if there is
// one, or the reason why the video cannot be used. Decodes up to a second at the beginning and the last part,
// so damage in the middle may go unnoticed.
Result<std::string> checkVideo(const Path& file);

// As checkVideo(), for a depth track (DepthTrack.h); decodes all frames.
Result<std::string> checkDepthTrack(const Path& file);

// As checkVideo(), for photos and high dynamic range pictures; decodes them whole. layer: see readHdr().
Result<std::string> checkPicture(const Path& file, const std::string& layer = {});

// As that of these three which fits the file's content.
Result<std::string> checkMedia(const Path& file, const std::string& layer = {});

} // namespace shoal::media
