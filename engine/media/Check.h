// One-line descriptions of video, picture and depth files for `shoal check`.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <string>

namespace shoal::media {

// Returns a description ("2048x1024 h264 video, ..."), also of the depth track beside the file if there is
// one, or the reason why the video cannot be used. Decodes up to a second at the beginning and the last part,
// so damage in the middle may go unnoticed.
Result<std::string> checkVideo(const Path& file);

// As checkVideo(), for a depth track (DepthTrack.h); decodes all frames.
Result<std::string> checkDepthTrack(const Path& file);

// As checkVideo(), for photos and high dynamic range pictures; decodes them whole. layer: see readHdr().
Result<std::string> checkPicture(const Path& file, const std::string& layer = {});

// As that of these three which fits the file's content (MediaKind.h).
Result<std::string> checkMedia(const Path& file, const std::string& layer = {});

} // namespace shoal::media
