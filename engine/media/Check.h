// Kind of a media file by its content, for every command, for files dropped on the window and for lists of
// files; and one-line descriptions of video, picture and depth files for `shoal check`.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <string>

namespace shoal::media {

// Photo: coded; Hdr: a high dynamic range picture.
enum class MediaKind { Photo, Hdr, Video, DepthTrack };

// Returns a file's kind by its content, not its name. Reads some kilobytes and a video's headers. The error
// says, if possible, what else the file is ("is a HEIC picture; convert it to JPEG", "is only sound"). A file
// whose kind is known may still be damaged. layer: if it is not empty, only OpenEXR is accepted.
Result<MediaKind> mediaKind(const Path& file, const std::string& layer = {});

// Returns a description ("2048x1024 h264 video, ..."), also of a depth track beside the file, or the reason
// why the video cannot be used. Decodes the first second and the last part: damage between may go unnoticed.
Result<std::string> checkVideo(const Path& file);

// Does the same as checkVideo() for a depth track (DepthTrack.h); decodes all frames.
Result<std::string> checkDepthTrack(const Path& file);

// Does the same for photos and high dynamic range pictures; decodes them whole. layer: see readHdr().
Result<std::string> checkPicture(const Path& file, const std::string& layer = {});

// Calls the one of these three functions that fits the file's content.
Result<std::string> checkMedia(const Path& file, const std::string& layer = {});

} // namespace shoal::media
